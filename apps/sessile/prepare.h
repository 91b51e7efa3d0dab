#pragma once

#include <string>
#include <vector>

#include "sessile/scene/read.h"
#include "sessile/simulation.h"

namespace sessile::app {

/// Reads a scene with everything that a run needs of it judged, the names of its output too. Throws SceneError.
ResolvedScene read_runnable_scene(const std::string& file, const std::vector<std::string>& overrides,
                                  MeshPlaces places);

/// The simulation at its start. Finds what only sampling shows: overlaps, liquid inside solids, meshes, memory; throws
/// them as SceneError, with the place in the file where one is known.
Simulation set_up(const ResolvedScene& resolved, const std::string& file);

}  // namespace sessile::app
