#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "outcome.h"
#include "record.h"

namespace sessile::app {

/// A run at a fixed step, made by the search for the largest one.
struct TrialReport {
  double dt = 0;       ///< [s]
  bool whole = true;   ///< whether it was to go to the scene's end
  std::string folder;  ///< below that of the comparison
  RunRecord record{};
};

/// What came of one method.
struct MethodReport {
  std::string name, title, file;
  std::string kind;                ///< of its first run's step: adaptive or fixed
  std::optional<RunRecord> run{};  ///< nothing when it was not reached
  Outcome outcome{};
  std::vector<TrialReport> trials{};
  bool searched = false;                 ///< whether the search came to its end
  std::optional<TrialReport> largest{};  ///< the run at the largest sound step
  Outcome largest_outcome{};
};

/// All that the report tells.
struct Comparison {
  std::filesystem::path folder;
  std::string scene_file, scene_title;
  double end = 0;  ///< of the scene [s]
  int threads = 0;
  bool interrupted = false;
  bool search = false;
  double search_until = 0;    ///< [s]
  std::string plots_trouble;  ///< why there are no plots; "" when there are
  std::vector<MethodReport> methods{};
};

/// A row of the tables: a method by one kind of step.
struct Row {
  const MethodReport* method = nullptr;
  std::string step;  ///< adaptive, fixed, largest fixed
  const RunRecord* run = nullptr;
  const Outcome* outcome = nullptr;
};

/// The rows of all runs there are, the methods in their order.
std::vector<Row> rows_of(const Comparison& comparison);

/// Stepping time per simulated second over that of the first method's first run; 0 where one of them is not known.
double factor_to_first(const Comparison& comparison, const RunRecord& run);

/// Each method's sound run to the end that takes the least time per simulated second, trials of the search among them;
/// methods without one are left out, and outcomes are not given.
std::vector<Row> fastest_sound(const Comparison& comparison);

std::string comparison_json(const Comparison& comparison);
std::string comparison_csv(const Comparison& comparison);
std::string comparison_markdown(const Comparison& comparison);

}  // namespace sessile::app
