#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "folder_lock.h"
#include "progress.h"
#include "sessile/output/summary.h"
#include "sessile/scene/read.h"
#include "sessile/simulation.h"
#include "session_state.h"
#include "signals.h"

namespace sessile::app {

struct SessionOptions {
  std::string scene_file;  ///< for messages
  std::filesystem::path folder;
  ProgressStyle progress = ProgressStyle::none;
  std::string name;         ///< of this run, where a program makes several
  bool checkpoints = true;  ///< whether to write those that the scene asks for
  bool changed = false;     ///< of a run that goes on: whether its scene is not that of its checkpoint
};

/// How a run went.
struct SessionResult {
  RunStatus status = RunStatus::done;
  std::string message;       ///< what went wrong, or why it was stopped
  std::exception_ptr error;  ///< of a run that failed
  double wall = 0;           ///< of all of it, before it was resumed too [s]
  double stepping = 0;       ///< of the steps alone: no output, no measures [s]
  std::int64_t frames = 0;
  bool resumable = false;  ///< whether there is a checkpoint of its end
  SimulationFacts facts{};
};

/// Called after each step; a text ends the run as `stopped`, for that reason.
using StepWatch = std::function<std::string(const Simulation&)>;

/// Runs a scene into a folder: frames, stats.csv, summary.json. Ctrl-C ends it after the step at hand; a second one
/// ends the program at once. What goes wrong in a step, or with the files meanwhile, stands in the result, and what has
/// been written stays good. Throws SceneError, FolderInUse and FileError of what comes before the first step, FileError
/// of what comes after the last.
SessionResult run_session(const ResolvedScene& resolved, const SessionOptions& options, const StepWatch& watch = {});

/// Goes on with a simulation and its files from where a checkpoint left them.
/// `lock` has been held since the checkpoint was read.
SessionResult resume_session(Simulation simulation, const SessionOptions& options, const SessionState& before,
                             const FolderLock& lock);

}  // namespace sessile::app
