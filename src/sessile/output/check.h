#pragma once

#include <string>
#include <vector>

#include "sessile/scene/scene.h"

namespace sessile {

/// What is wrong with a scene's output formats and fields, one line each, such as
/// `output.formats[1]: unknown format "vtk" (did you mean "vtp"?)`; empty when all is well.
std::vector<std::string> check_output(const Scene& scene);

}  // namespace sessile
