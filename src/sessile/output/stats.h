#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sessile/measure/diagnostics.h"
#include "sessile/output/file.h"
#include "sessile/simulation.h"

namespace sessile {

/// What one line of stats.csv is made of.
struct StatsRow {
  double time = 0;  ///< [s]
  StepReport last_step{};
  Totals totals{};
  Diagnostics measured{};
  std::span<const SolidForce> solids{};
};

/// First line of stats.csv: each column's name and unit, `time [s]`. Solids without a label, or with one that another
/// has already, are called solid0, solid1 ... by their place.
std::string stats_header(std::span<const std::string> solid_labels);

/// One line of stats.csv. Numbers are written with the fewest digits that give the same double back, in any locale.
std::string stats_line(const StatsRow& row);

/// Writes stats.csv line by line. Lines written stay good whenever the program ends.
class StatsWriter {
 public:
  /// Opens the file anew and writes its header. Throws FileError.
  StatsWriter(const std::filesystem::path& path, std::span<const std::string> solid_labels);

  /// Appends a line. Throws FileError; then no half line is left.
  void write(const StatsRow& row);

  /// Appends a line for the simulation as it stands.
  void write(const Simulation& simulation, const Diagnostics& measured);

 private:
  LineFile file_;
};

}  // namespace sessile
