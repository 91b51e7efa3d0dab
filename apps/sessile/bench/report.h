#pragma once

#include <string>
#include <vector>

#include "bench/figure.h"

namespace sessile::app::bench {

/// Figures as they come: printed at once, line by line, and kept for the file.
class Report {
 public:
  /// Without goals at sizes that they were not set for.
  explicit Report(bool goals) : goals_(goals) {}

  void section(const std::string& title);
  void add(Figure figure);
  void remark(const std::string& sentence);

  const std::vector<Figure>& figures() const { return figures_; }
  const std::vector<std::string>& remarks() const { return remarks_; }
  bool goals() const { return goals_; }

 private:
  bool goals_;
  std::vector<Figure> figures_;
  std::vector<std::string> remarks_;
};

/// Everything as JSON: machine, program, every figure with all its samples, remarks.
std::string report_json(const Report& report);

}  // namespace sessile::app::bench
