#pragma once

#include <filesystem>
#include <optional>

#include "mesh/surface_recorder.h"
#include "schedule.h"
#include "sessile/output/stats.h"
#include "sessile/output/summary.h"
#include "sessile/output/writer.h"
#include "sessile/simulation.h"
#include "session_state.h"

namespace sessile::app {

/// Writes what a scene's output block asks for while a simulation runs: frames, surfaces, stats.csv, and summary.json
/// at the end. A frame or line falls due with the first state at or after its time, and carries that state's own time.
class Recorder {
 public:
  /// Makes the folder, writes the solids and the state at the start; or goes on from what had been written when a
  /// checkpoint was taken, and takes back what came after it. Throws FileError.
  Recorder(const std::filesystem::path& folder, const Simulation& simulation,
           const std::optional<SessionState>& before = {});

  /// Called after each step. Throws FileError when something could not be written.
  void record(const Simulation& simulation);

  /// What has been written, all of it on disk. Throws FileError.
  SessionState settle();

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
  double output_seconds_ = 0, measure_seconds_ = 0, writer_seconds_before_ = 0;
};

}  // namespace sessile::app
