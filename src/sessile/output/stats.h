#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sessile/measure/diagnostics.h"
#include "sessile/output/file.h"
#include "sessile/simulation.h"

namespace sessile {

/// The liquid's surface as a whole.
struct SurfaceMeasures {
  double area = 0;    ///< [m^2]
  double volume = 0;  ///< enclosed [m^3]
};

/// What one line of stats.csv is made of.
struct StatsRow {
  double time = 0;  ///< [s]
  StepReport last_step{};
  Totals totals{};
  Diagnostics measured{};
  std::span<const SolidForce> solids{};
  std::optional<SurfaceMeasures> surface{};  ///< where the file has columns for it
};

/// First line of stats.csv: each column's name and unit, `time [s]`. Solids without a label, or with one that another
/// has already, are called solid0, solid1 ... by their place. `surface`: whether there are columns of the surface.
std::string stats_header(std::span<const std::string> solid_labels, bool surface = false);

/// One line of stats.csv. Numbers are written with the fewest digits that give the same double back, in any locale.
std::string stats_line(const StatsRow& row);

/// Writes stats.csv line by line. Lines written stay good whenever the program ends.
class StatsWriter {
 public:
  /// Opens the file anew and writes its header. Throws FileError.
  StatsWriter(const std::filesystem::path& path, std::span<const std::string> solid_labels, bool surface = false);

  /// Goes on with a file that it wrote. Throws FileError.
  StatsWriter(const std::filesystem::path& path, Keep keep) : file_(path, keep) {}

  /// Appends a line. Throws FileError; then no half line is left.
  void write(const StatsRow& row);

  /// Appends a line for the simulation as it stands.
  void write(const Simulation& simulation, const Diagnostics& measured,
             const std::optional<SurfaceMeasures>& surface = {});

  /// Makes sure that the disk has the lines, and says how long the file is [bytes]. Throws FileError.
  std::uint64_t settle() const {
    file_.sync();
    return file_.size();
  }

 private:
  LineFile file_;
};

}  // namespace sessile
