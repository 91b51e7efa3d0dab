#include "sessile/scene/mesh_space.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sessile {

namespace {

// Axes of the tree. The ray runs along the third, whose direction no lattice and no modelled edge is likely to share.
constexpr Vec3d ray{0.28571933764112467, 0.45106223580113546, 0.84551742306437581};

Vec3d first_axis() {
  const Vec3d side = cross(Vec3d{1, 0, 0}, ray);
  return 1 / length(side) * side;
}

/// Twice the area of a, b, p seen along z. Never inlined: two triangles that share the edge must get the same bits.
[[gnu::noinline]] double edge_side(const Vec3d& a, const Vec3d& b, const Vec3d& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Six times the volume of a, b, c, d.
[[gnu::noinline]] double corner_side(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  return dot(b - a, cross(c - a, d - a));
}

}  // namespace

MeshSpace::MeshSpace(const TriangleMesh& mesh)
    : centre_(0.5 * (mesh.lower() + mesh.upper())), triangles_(mesh.triangles) {
  vertices_.reserve(mesh.vertices.size());
  for (const auto& v : mesh.vertices) vertices_.push_back(turned(v));
  nodes_.reserve(triangles_.size() / 2 + 1);
  nodes_.push_back({});
  nodes_.front().end = static_cast<std::uint32_t>(triangles_.size());
  split(0);
}

Vec3d MeshSpace::turned(const Vec3d& point) const {
  static const Vec3d z = 1 / length(ray) * ray;
  static const Vec3d x = first_axis();
  static const Vec3d y = cross(z, x);
  const Vec3d d = point - centre_;
  return {dot(d, x), dot(d, y), dot(d, z)};
}

MeshSpace::Box MeshSpace::box_of(std::uint32_t begin, std::uint32_t end) const {
  Box box{vertices_[triangles_[begin][0]], vertices_[triangles_[begin][0]]};
  for (std::uint32_t t = begin; t < end; ++t) {
    for (const auto v : triangles_[t]) {
      const Vec3d& p = vertices_[v];
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
  }
  return box;
}

void MeshSpace::split(std::uint32_t node) {
  constexpr std::uint32_t leaf_size = 4;
  const auto begin = nodes_[node].begin, end = nodes_[node].end;
  if (begin == end) return;
  const Box box = nodes_[node].box = box_of(begin, end);
  if (end - begin <= leaf_size) return;
  const Vec3d size = box.high - box.low;
  double Vec3d::*const axis = size.x >= size.y && size.x >= size.z ? &Vec3d::x
                              : size.y >= size.z                   ? &Vec3d::y
                                                                   : &Vec3d::z;
  const auto middle_of = [&](const Triangle& t) {
    return vertices_[t[0]].*axis + vertices_[t[1]].*axis + vertices_[t[2]].*axis;
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle, triangles_.begin() + end,
                   [&](const Triangle& a, const Triangle& b) { return middle_of(a) < middle_of(b); });
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].left = left;
  nodes_.push_back({{}, begin, middle, 0});
  nodes_.push_back({{}, middle, end, 0});
  split(left);
  split(left + 1);
}

/// Visits the triangles of leaves whose boxes overlap until visit(triangle) says to stop; whether it did.
template <class Overlaps, class Visit>
bool MeshSpace::any(Overlaps&& overlaps, Visit&& visit) const {
  std::array<std::uint32_t, 128> stack;  // halving 2^32 triangles takes 32 levels
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (!overlaps(node.box)) continue;
    if (node.left != 0) {
      stack[depth++] = node.left;
      stack[depth++] = node.left + 1;
      continue;
    }
    for (std::uint32_t t = node.begin; t < node.end; ++t) {
      if (visit(triangles_[t])) return true;
    }
  }
  return false;
}

bool MeshSpace::contains(const Vec3d& point) const {
  const Vec3d p = turned(point);
  bool inside = false;
  any(
      [&](const Box& b) {
        return p.x >= b.low.x && p.x <= b.high.x && p.y >= b.low.y && p.y <= b.high.y && p.z <= b.high.z;
      },
      [&](const Triangle& t) {
        inside = inside != above(t, p);
        return false;
      });
  return inside;
}

/// The triangle's area as seen along z.
double MeshSpace::shadow(const Triangle& triangle) const {
  return 0.5 * std::abs(edge_side(vertices_[triangle[0]], vertices_[triangle[1]], vertices_[triangle[2]]));
}

/// Length inside the mesh of the line along z through a point, over the number of triangles that it meets.
double MeshSpace::inside_share(const Vec3d& point) const {
  std::vector<double> heights;
  const double below = nodes_.front().box.low.z - 1;
  any(
      [&](const Box& b) {
        return point.x >= b.low.x && point.x <= b.high.x && point.y >= b.low.y && point.y <= b.high.y;
      },
      [&](const Triangle& t) {
        if (!above(t, {point.x, point.y, below})) return false;
        const Vec3d &a = vertices_[t[0]], &b = vertices_[t[1]], &c = vertices_[t[2]];
        const double u = edge_side(b, c, point), v = edge_side(c, a, point), w = edge_side(a, b, point);
        heights.push_back((u * a.z + v * b.z + w * c.z) / (u + v + w));
        return false;
      });
  std::sort(heights.begin(), heights.end());
  double inside = 0;
  for (std::size_t k = 0; k + 1 < heights.size(); k += 2) inside += heights[k + 1] - heights[k];
  return heights.empty() ? 0 : inside / static_cast<double>(heights.size());
}

double MeshSpace::rough_volume() const {
  // So many that they do not take long where every line meets every triangle.
  const std::size_t lines =
      std::clamp<std::size_t>(200'000'000 / std::max<std::size_t>(1, triangles_.size()), 64, 1024);
  const auto count = static_cast<double>(lines);
  double total = 0;
  for (const Triangle& t : triangles_) total += shadow(t);
  // A line meets every triangle over its place: what is spread over areas counts as often as there are triangles.
  double sum = 0, passed = 0;
  std::size_t line = 0;
  for (const Triangle& t : triangles_) {
    passed += shadow(t);
    for (; line < lines && (static_cast<double>(line) + 0.5) / count * total < passed; ++line) {
      double u = std::fmod(static_cast<double>(line) * 0.7548776662466927 + 0.5, 1.0);  // evenly, by the plastic number
      double v = std::fmod(static_cast<double>(line) * 0.5698402909980532 + 0.5, 1.0);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3d& a = vertices_[t[0]];
      sum += inside_share(a + u * (vertices_[t[1]] - a) + v * (vertices_[t[2]] - a));
    }
  }
  return total * sum / count;
}

/// Whether the ray from the point along z meets the triangle. Each edge is judged from its lower vertex to its higher,
/// and a point on it counts to one side, so that exactly one of two neighbours is met.
bool MeshSpace::above(const Triangle& triangle, const Vec3d& point) const {
  std::array<double, 3> weight{};
  std::array<bool, 3> left{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto a = triangle[k], b = triangle[(k + 1) % 3];
    const double side = edge_side(vertices_[std::min(a, b)], vertices_[std::max(a, b)], point);
    left[k] = (side > 0) == (a < b);
    weight[(k + 2) % 3] = a < b ? side : -side;
  }
  if (left[0] != left[1] || left[1] != left[2]) return false;
  const double sum = weight[0] + weight[1] + weight[2];
  const auto height = [&](std::size_t k) { return vertices_[triangle[k]].z - point.z; };
  const double z = weight[0] * height(0) + weight[1] * height(1) + weight[2] * height(2);
  return sum > 0 ? z > 0 : z < 0;
}

bool MeshSpace::crossed(const Vec3d& a, const Vec3d& b) const {
  const Vec3d p = turned(a), q = turned(b);
  const Vec3d low{std::min(p.x, q.x), std::min(p.y, q.y), std::min(p.z, q.z)};
  const Vec3d high{std::max(p.x, q.x), std::max(p.y, q.y), std::max(p.z, q.z)};
  return any(
      [&](const Box& box) {
        return low.x <= box.high.x && high.x >= box.low.x && low.y <= box.high.y && high.y >= box.low.y &&
               low.z <= box.high.z && high.z >= box.low.z;
      },
      [&](const Triangle& t) { return passes(t, p, q); });
}

/// Whether the way from a to b meets the triangle. What lies within rounding of an edge or a corner counts as met, for
/// each of the triangles there: none shall slip through between them.
bool MeshSpace::passes(const Triangle& triangle, const Vec3d& a, const Vec3d& b) const {
  const Vec3d &u = vertices_[triangle[0]], &v = vertices_[triangle[1]], &w = vertices_[triangle[2]];
  if ((corner_side(u, v, w, a) >= 0) == (corner_side(u, v, w, b) >= 0)) return false;
  bool left = true, right = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &p = vertices_[triangle[k]], &q = vertices_[triangle[(k + 1) % 3]];
    const double side = corner_side(a, b, p, q);
    const double rounding = 1e-14 * length(b - a) * length(p - a) * length(q - a);
    left = left && side >= -rounding;
    right = right && side <= rounding;
  }
  return left || right;
}

}  // namespace sessile
