#pragma once

#include <string>
#include <vector>

#include "sessile/scene/mesh.h"

namespace sessile {

/// Places [m] of samples on a mesh, 0.8 to 1.3 per spacing^2, evenly spread whatever the triangles: corners first, then
/// a fine raster of each triangle, of which a place is taken when no sample is nearer than 0.86 spacing. Further
/// layers of a closed mesh lie inside it, parallel to its triangles. The same mesh gives the same samples.
/// Throws SceneError for more samples than can be numbered, and for further layers of a mesh that is not closed.
std::vector<Vec3d> sample_mesh(const TriangleMesh& mesh, double spacing, int layers, const std::string& who);

/// Roughly how many samples a layer takes: area over spacing^2, and for long thin triangles length over spacing.
double estimate_mesh(const TriangleMesh& mesh, double spacing);

}  // namespace sessile
