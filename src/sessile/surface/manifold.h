#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sessile/surface/surface_mesh.h"

namespace sessile {

/// How a mesh falls short of a closed surface that is a manifold and faces one way, and what shape it has.
struct MeshReport {
  std::size_t bad_edges = 0;     ///< not in exactly two triangles that run along them in opposite directions
  std::size_t bad_vertices = 0;  ///< whose triangles do not make one ring around them, or that have none
  std::size_t bad_points = 0;    ///< coordinates or normals that are not finite
  std::size_t pieces = 0;        ///< connected surfaces
  std::ptrdiff_t euler = 0;      ///< vertices - edges + triangles: 2 for each piece without holes through it

  bool closed_manifold() const { return bad_edges == 0 && bad_vertices == 0 && bad_points == 0; }
};

/// Looks at every edge and vertex.
MeshReport inspect(const SurfaceMesh& mesh);

/// The vertices that MeshReport::bad_vertices counts; the ends of bad edges are among them.
std::vector<std::uint32_t> bad_vertices(const SurfaceMesh& mesh);

}  // namespace sessile
