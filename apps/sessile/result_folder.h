#pragma once

#include <cstdint>
#include <filesystem>

#include "session_state.h"

namespace sessile::app {

/// Makes a folder for results, and takes out those of an earlier run into it: left beside fewer new ones they would
/// pass for theirs. stats.csv is begun anew in any case. Throws FileError.
const std::filesystem::path& fresh_folder(const std::filesystem::path& folder);

/// Takes out of a folder of results what was written after a checkpoint of this step, newer checkpoints too, and half
/// files of a run that was killed. Throws FileError.
const std::filesystem::path& rewound_folder(const std::filesystem::path& folder, const SessionState& state,
                                            std::int64_t step);

}  // namespace sessile::app
