#pragma once

#include "sessile/scene/scene.h"

namespace sessile::fuzz {

/// Sets the scene up and makes one step, where that takes a moment only: few particles, and few turns of the solver.
/// Otherwise asks just whether it fits into memory.
void run_when_small(const Scene& scene);

}  // namespace sessile::fuzz
