#pragma once

#include "sessile/surface/block_field.h"
#include "sessile/surface/surface_mesh.h"

/// From a field to triangles. Internal.
namespace sessile {

/// The surface where the field is 0, by marching cubes: points, in units of `unit` [m], and triangles. Throws Error
/// when it has more vertices than 32 bits can number.
SurfaceMesh march(const BlockMap& map, const BlockField& field, double unit);

}  // namespace sessile
