#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "schedule.h"
#include "sessile/checkpoint/checkpoint.h"
#include "sessile/simulation.h"

namespace sessile::app {

/// Of the folder of checkpoints in a folder of results.
inline constexpr std::string_view checkpoint_folder_name = "checkpoints";

/// The checkpoints of a run, as it goes on: the newest few of them, each a file that is named by its step.
class Checkpoints {
 public:
  /// `results` is the folder of the run, `last` the time of the checkpoint that it goes on from [s].
  Checkpoints(const std::filesystem::path& results, const CheckpointOutput& asked, std::optional<double> last);

  /// Whether one should be written now.
  bool due(const Simulation& simulation) const;

  /// Writes one, and takes out those that are no longer kept. Throws FileError.
  void write(const Scene& scene, SimulationState state, const std::string& session);

  /// Notes that the one that was due at this time has been written: it may hold an earlier state [s].
  void served(double time);

  bool wanted() const { return keep_ > 0; }

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path folder_;
  std::size_t keep_;
  std::chrono::duration<double> pause_;
  std::optional<Schedule> schedule_;
  Clock::time_point last_ = Clock::now();
};

/// A checkpoint to go on from, and what was wrong with newer ones.
struct FoundCheckpoint {
  std::filesystem::path file;
  Checkpoint checkpoint;
  std::vector<std::string> passed_over;  ///< why, one line each
};

/// The newest whole checkpoint of a run, or the newest that is not after `at` [s].
/// Throws FileError when there is none, ForeignCheckpoint when the newest is one, unless `at` asks for an earlier one.
FoundCheckpoint find_checkpoint(const std::filesystem::path& results, std::optional<double> at);

/// Whether a run has left any in its folder of results.
bool has_checkpoints(const std::filesystem::path& results);

/// Removes the checkpoints of a run that were taken after a step, all of them without one, and what a killed run left
/// half written. Throws FileError.
void remove_checkpoints(const std::filesystem::path& results, std::optional<std::int64_t> after_step = {});

}  // namespace sessile::app
