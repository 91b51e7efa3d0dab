#pragma once

#include "sessile/scene/scene.h"
#include "sessile/simulation_state.h"

namespace sessile::fuzz {

/// Sets the scene up and makes one step, where that takes a moment only: few particles, and few turns of the solver.
/// Otherwise asks just whether it fits into memory.
void run_when_small(const Scene& scene);

/// The same of a scene that goes on from a state; two steps.
void go_on_when_small(const Scene& scene, const SimulationState& state);

}  // namespace sessile::fuzz
