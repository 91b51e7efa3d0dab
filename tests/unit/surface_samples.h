#pragma once

#include "sessile/surface/surface_mesh.h"

namespace sessile::test {

/// A tetrahedron that carries columns of every kind.
SurfaceMesh tetrahedron_with_columns(double time = 0.1);

}  // namespace sessile::test
