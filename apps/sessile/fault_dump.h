#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sessile/measure/health.h"
#include "sessile/output/snapshot.h"
#include "sessile/simulation.h"

namespace sessile::app {

/// Of the folder in a folder of results that shows how a run went unstable.
inline constexpr std::string_view fault_folder_name = "fault";

/// What tells such a folder from other results. A run that goes on there, or is written there, takes it out.
inline constexpr std::string_view fault_file_name = "fault.json";

/// The simulation right after the step that failed, as far as its numbers are finite: a particle that got no finite
/// place stands where it stood before, and other numbers that are not finite are 0.
Snapshot faulty_frame(const Simulation& simulation, const RunFault& fault);

/// Makes a folder of results of its own, which `sessile view`, `picture` and `run --resume` open: frame 0 is the good
/// state, frame 1 the faulty one; a line of stats.csv and a checkpoint of the good state, and fault.json.
/// Throws FileError, and leaves nothing of it then; also where other results stand in that folder.
void write_fault_dump(const std::filesystem::path& folder, const Simulation& good, const Snapshot& faulty,
                      const RunFault& fault, const std::string& advice);

/// Removes the folder that an earlier run left; other files in it stay, and so does a folder that is no such dump, or
/// one that a run has gone on in. Throws FileError.
void remove_fault_dump(const std::filesystem::path& folder);

}  // namespace sessile::app
