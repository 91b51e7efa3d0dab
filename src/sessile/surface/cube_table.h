#pragma once

#include <array>
#include <cstdint>
#include <vector>

/// Which triangles cut a cube, by which of its corners lie inside. Internal.
namespace sessile {

/// Corner k of a cube lies at (k & 1, k >> 1 & 1, k >> 2).
inline constexpr int corner_count = 8;

/// Edge 4 d + o runs along axis d; o holds its place along the two other axes, in their order, one bit each.
inline constexpr int edge_count = 12;

/// The corner at which an edge starts; it ends at that corner + (1 << axis).
constexpr int edge_start(int edge) {
  const int axis = edge / 4, low = edge & 1, high = edge >> 1 & 1;
  const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
  return low << first | high << second;
}
constexpr int edge_end(int edge) { return edge_start(edge) + (1 << edge / 4); }

/// The triangles of one case: three edges each, on which their vertices lie, counterclockwise from outside.
struct CubeCase {
  static constexpr int most_triangles = 5;

  int triangles = 0;
  std::array<std::uint8_t, 3 * most_triangles> edges{};
};

/// Marching cubes' cases, by the bits of the corners that lie inside, made so that the surface is a manifold whatever
/// the field (docs/decisions/surfaces.md):
/// - where two diagonal corners of a face lie inside and the others outside, one rule for all faces says that the
///   insides meet, so that the cubes on both sides of the face cut it alike;
/// - no diagonal of a cut polygon lies in a face, where the cube beyond could have the same one.
class CubeTable {
 public:
  CubeTable();

  const CubeCase& operator[](unsigned inside) const { return cases_[inside]; }

 private:
  std::array<CubeCase, 256> cases_;
};

}  // namespace sessile
