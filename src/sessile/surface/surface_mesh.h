#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sessile/output/snapshot.h"

namespace sessile {

/// A surface as triangles with shared vertices: closed, each edge in two triangles, seen counterclockwise from outside.
struct SurfaceMesh {
  double time = 0;  ///< of the frame it was made from [s]
  std::int64_t step = 0;
  std::vector<float> points;             ///< x y z of each vertex [m]
  std::vector<float> normals;            ///< x y z of each vertex, of length 1, pointing out of the liquid
  std::vector<std::uint32_t> triangles;  ///< three vertices each
  std::vector<Column> columns;           ///< what vertices carry over from particles

  std::size_t vertex_count() const { return points.size() / 3; }
  std::size_t triangle_count() const { return triangles.size() / 3; }
};

/// Area of all triangles [m^2].
double surface_area(const SurfaceMesh& mesh);

/// Volume enclosed [m^3].
double enclosed_volume(const SurfaceMesh& mesh);

}  // namespace sessile
