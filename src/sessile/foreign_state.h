#pragma once

#include <cstdint>

#include "sessile/scene/scene.h"
#include "sessile/simulation_state.h"
#include "sessile/walls/walls.h"

namespace sessile {

/// Of what the solids are made of: the places of their samples and whose they are.
std::uint64_t digest(const Walls& walls);

/// Throws SceneError for a state that cannot be one of this scene's.
void refuse_foreign(const SimulationState& state, const Scene& scene, const Walls& walls);

}  // namespace sessile
