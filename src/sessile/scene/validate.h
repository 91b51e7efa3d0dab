#pragma once

#include <vector>

#include "sessile/scene/fault.h"
#include "sessile/scene/scene.h"

namespace sessile {

/// Every fault of a scene that its numbers show without sampling anything: single values out of their declared ranges
/// or not finite, and parameters that do not fit each other. Empty for a scene that can be tried. Formats and fields
/// of frames are judged by the output, overlaps and memory by the simulation.
std::vector<Fault> validate(const Scene& scene);

}  // namespace sessile
