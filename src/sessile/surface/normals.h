#pragma once

#include <vector>

#include "sessile/surface/surface_mesh.h"

namespace sessile {

/// For each vertex the mean normal of its triangles, by their area; x y z each.
std::vector<float> vertex_normals(const SurfaceMesh& mesh);

}  // namespace sessile
