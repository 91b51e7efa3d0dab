#pragma once

#include <vector>

#include "sessile/surface/cloud.h"
#include "sessile/surface/surface_mesh.h"

namespace sessile {

/// The particles' columns at the vertices of a mesh around them: floats as means weighted by (1 - q^2)^3 of the
/// distance over the search radius, whole numbers of the nearest particle.
std::vector<Column> carry_columns(const Snapshot& particles, const Cloud& cloud, const SurfaceMesh& mesh);

}  // namespace sessile
