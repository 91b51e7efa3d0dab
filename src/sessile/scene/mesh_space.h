#pragma once

#include <cstdint>
#include <vector>

#include "sessile/core/vec.h"
#include "sessile/scene/mesh.h"

namespace sessile {

/// A mesh as a body of space: a tree of boxes over its triangles answers what is inside and what passes through.
/// Both answers are watertight: a ray that meets a shared edge meets exactly one of its triangles, a way at least one.
class MeshSpace {
 public:
  explicit MeshSpace(const TriangleMesh& mesh);

  /// Whether the point lies inside a closed mesh, by the parity of the triangles that a ray from it meets.
  bool contains(const Vec3d& point) const;

  /// Roughly the volume of what contains() holds, from lines through points spread evenly over the triangles. Unlike a
  /// sum over the triangles it does not take one part from another where they face opposite ways.
  double rough_volume() const;

  /// Whether the way from a to b passes through a triangle.
  bool crossed(const Vec3d& a, const Vec3d& b) const;

 private:
  struct Box {
    Vec3d low{}, high{};
  };
  struct Node {
    Box box;
    std::uint32_t begin = 0, end = 0;  // triangles of a leaf
    std::uint32_t left = 0;            // first child of an inner node, the second follows it; 0 in a leaf
  };
  using Triangle = std::array<std::uint32_t, 3>;

  Vec3d turned(const Vec3d& point) const;
  Box box_of(std::uint32_t begin, std::uint32_t end) const;
  void split(std::uint32_t node);
  bool above(const Triangle& triangle, const Vec3d& point) const;
  double shadow(const Triangle& triangle) const;
  double inside_share(const Vec3d& point) const;
  bool passes(const Triangle& triangle, const Vec3d& a, const Vec3d& b) const;
  template <class Overlaps, class Visit>
  bool any(Overlaps&& overlaps, Visit&& visit) const;

  Vec3d centre_;
  std::vector<Vec3d> vertices_;  // turned so that the ray of contains() runs along z
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace sessile
