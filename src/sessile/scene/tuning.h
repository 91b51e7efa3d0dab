#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sessile/scene/scene.h"

namespace sessile {

/// Whether a parameter, such as "forces[0].cohesion", may change between two steps of a run. All others shape the state
/// that a run starts from, so that they need a new one: spacing, rest density, bodies, where solids stand ...
bool may_change_between_steps(std::string_view path);

/// `running` with those parameters of `wanted` that may change between two steps. Solids are told by their place in the
/// list.
Scene tuned(Scene running, const Scene& wanted);

/// Paths of the parameters in which two scenes differ, in the order of the first; then those the second alone has.
std::vector<std::string> differing_parameters(const Scene& first, const Scene& second);

}  // namespace sessile
