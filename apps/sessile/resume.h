#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "session.h"

namespace sessile::app {

/// What to go on with, and how.
struct ResumeOptions {
  std::filesystem::path folder;        ///< of the run's results
  std::optional<double> at;            ///< from the newest checkpoint that is not after this time [s]
  std::vector<std::string> overrides;  ///< `path=value`, of what may change
};

/// A run that can go on.
struct Resumable {
  Simulation simulation;
  SessionState before;
  bool changed = false;            ///< whether its scene is not that of the checkpoint
  std::vector<std::string> notes;  ///< what the user should know, one line each
};

/// Opens the newest checkpoint of a run that is whole, and puts the overrides over its scene.
/// Throws SceneError for what may not change, and FileError when there is no checkpoint to go on from.
Resumable open_run(const ResumeOptions& options);

/// Whether the run in this folder has come to its end and written all that belongs to it.
bool is_complete(const std::filesystem::path& results, const Simulation& run);

/// Throws FileError when the files that a run goes on with are not there any more, FolderInUse when another program
/// works on some of them.
void require_results(const std::filesystem::path& results, const Resumable& run);

}  // namespace sessile::app
