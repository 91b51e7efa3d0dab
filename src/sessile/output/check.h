#pragma once

#include <vector>

#include "sessile/scene/fault.h"
#include "sessile/scene/scene.h"

namespace sessile {

/// Formats and fields that a scene's output names and that do not exist; validate() finds those listed twice.
std::vector<Fault> check_output(const Scene& scene);

}  // namespace sessile
