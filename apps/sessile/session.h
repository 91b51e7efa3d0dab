#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>

#include "progress.h"
#include "sessile/output/summary.h"
#include "sessile/scene/read.h"
#include "sessile/simulation.h"
#include "signals.h"

namespace sessile::app {

struct SessionOptions {
  std::string scene_file;  ///< for messages
  std::filesystem::path folder;
  ProgressStyle progress = ProgressStyle::none;
  std::string name;  ///< of this run, where a program makes several
};

/// How a run went.
struct SessionResult {
  RunStatus status = RunStatus::done;
  std::string message;       ///< what went wrong, or why it was stopped
  std::exception_ptr error;  ///< of a run that failed
  double wall = 0;           ///< of all of it [s]
  double stepping = 0;       ///< of the steps alone: no output, no measures [s]
  std::int64_t frames = 0;
  SimulationFacts facts{};
};

/// Called after each step; a text ends the run as `stopped`, for that reason.
using StepWatch = std::function<std::string(const Simulation&)>;

/// Runs a scene into a folder: frames, stats.csv, summary.json. Ctrl-C ends it after the step at hand; a second one
/// ends the program at once. What goes wrong in a step, or with the files meanwhile, stands in the result, and what has
/// been written stays good. Throws SceneError, FolderInUse and FileError of what comes before the first step, FileError
/// of what comes after the last.
SessionResult run_session(const ResolvedScene& resolved, const SessionOptions& options, const StepWatch& watch = {});

}  // namespace sessile::app
