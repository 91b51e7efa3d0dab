#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "schedule.h"
#include "sessile/output/stats.h"
#include "sessile/simulation.h"
#include "surface_folder.h"

namespace sessile::app {

/// Throws FileError unless a run can go on with the surfaces of these times that it has made into its results [s].
void require_surfaces(const std::filesystem::path& results, const Scene& scene, const std::vector<double>& times);

/// Makes the surfaces that a scene asks for while it runs: files in the folder surface of its results, and the
/// surface's measures for stats.csv.
class SurfaceRecorder {
 public:
  /// `results` is the folder of the run, `times` those of the surfaces that are there already [s]; others are removed.
  /// Throws FileError.
  SurfaceRecorder(const std::filesystem::path& results, const Scene& scene, std::vector<double> times = {});

  /// Called after each step: writes a surface when one is due. Throws FileError.
  void record(const Simulation& simulation);

  /// Times of all surfaces [s], once they are on disk. Throws FileError.
  const std::vector<double>& settle() const {
    if (folder_) folder_->sync();
    return times_;
  }

  /// Area and volume of the surface now, where the scene asks for them.
  std::optional<SurfaceMeasures> measure(const Simulation& simulation);

  /// Writes the last state's surface, unless the run has failed, and what completes the files. Throws FileError.
  void finish(const Simulation& simulation, bool failed);

 private:
  void write(const Simulation& simulation);

  std::optional<SurfaceOutput> asked_;
  Schedule schedule_;
  std::optional<SurfaceFolder> folder_;  // when there are formats
  std::vector<double> times_;
  double measured_time_ = -1;  // of measures_ [s]
  SurfaceMeasures measures_{};
};

}  // namespace sessile::app
