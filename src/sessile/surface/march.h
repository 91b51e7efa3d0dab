#pragma once

#include <cstdint>

#include "sessile/surface/block_field.h"
#include "sessile/surface/surface_mesh.h"

/// From a field to triangles. Internal.
namespace sessile {

/// Throws Error where a surface has more than most_indices vertices or triangles.
void check_surface_size(std::uint64_t vertices, std::uint64_t triangles);

/// The surface where the field is 0, by marching cubes: points, in units of `unit` [m], and triangles. Throws Error
/// when it has more vertices or triangles than can be numbered.
SurfaceMesh march(const BlockMap& map, const BlockField& field, double unit);

}  // namespace sessile
