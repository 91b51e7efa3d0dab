#pragma once

#include <filesystem>

#include "mesh/surface_recorder.h"
#include "schedule.h"
#include "sessile/output/stats.h"
#include "sessile/output/summary.h"
#include "sessile/output/writer.h"
#include "sessile/simulation.h"

namespace sessile::app {

/// Writes what a scene's output block asks for while a simulation runs: frames, surfaces, stats.csv, and summary.json
/// at the end. A frame or line falls due with the first state at or after its time, and carries that state's own time.
class Recorder {
 public:
  /// Makes the folder, writes the solids and the state at the start. Throws FileError.
  Recorder(const std::filesystem::path& folder, const Simulation& simulation);

  /// Called after each step. Throws FileError when something could not be written.
  void record(const Simulation& simulation);

  /// Writes the last state, waits for the disk, and writes the summary. Throws FileError.
  void finish(const Simulation& simulation, RunFacts facts);

  std::int64_t frames() const { return frames_.frames_written(); }

 private:
  void write_frame(const Simulation& simulation);
  void write_stats(const Simulation& simulation);

  std::filesystem::path folder_;
  FrameWriter frames_;
  StatsWriter stats_;
  SurfaceRecorder surfaces_;
  Schedule frame_schedule_, stats_schedule_;
  double output_seconds_ = 0, measure_seconds_ = 0;
};

}  // namespace sessile::app
