#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sessile/core/vec.h"

namespace sessile {

/// Corners and triangles as a file lists them.
struct TriangleSoup {
  std::vector<Vec3d> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The surface in the text of a Wavefront OBJ file: its lines "v" and "f", polygons as fans. Nothing that the file
/// names is opened. Throws FileError with what is wrong, without the file's name; so do the others.
TriangleSoup parse_obj(std::string_view text);

/// The surface in an STL file, as text or binary.
TriangleSoup parse_stl(std::string_view bytes);

/// The surface in a PLY file, as text or binary of either byte order: x, y, z of "vertex", the indices of "face".
TriangleSoup parse_ply(std::string_view bytes);

/// Adds a polygon as a fan of triangles. A bent or concave one keeps its border, so a closed surface stays closed.
/// Throws FileError when an index is not of a corner.
void add_polygon(TriangleSoup& soup, const std::vector<std::int64_t>& polygon);

}  // namespace sessile
