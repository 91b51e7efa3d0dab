#pragma once

#include <optional>
#include <string>

#include "sessile/surface/surface_mesh.h"

namespace sessile::test {

/// A tetrahedron that carries columns of every kind.
SurfaceMesh tetrahedron_with_columns(double time = 0.1);

/// What Python says of a script, which must end well; nothing where a module is missing.
std::optional<std::string> python(const std::string& interpreter, const std::string& module, const std::string& script);

}  // namespace sessile::test
