#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "sessile/core/vec.h"
#include "sessile/scene/shapes.h"

namespace sessile {

/// Triangles with shared corners: vertices at the same place are one.
struct TriangleMesh {
  std::vector<Vec3d> vertices;  ///< [m], in the shape's own axes
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::size_t open_edges = 0;  ///< edges that an odd number of triangles share; 0 for a closed surface

  bool closed() const { return open_edges == 0; }
  double area() const;    ///< [m^2]
  double volume() const;  ///< [m^3] of a closed mesh whose triangles all face outwards; negative when they face inwards
  Vec3d lower() const;    ///< lowest corner of the box around the vertices [m]
  Vec3d upper() const;
};

/// Reads an OBJ, STL or PLY file. Throws FileError when it cannot be read, SceneError when it holds no triangles or
/// vertices that are not finite or beyond any scene.
TriangleMesh load_mesh(const Mesh& mesh);

/// The same from triangles in memory: joins equal vertices, leaves out triangles that are points or lines between two
/// corners, counts open edges.
TriangleMesh make_mesh(const std::vector<Vec3d>& corners, const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace sessile
