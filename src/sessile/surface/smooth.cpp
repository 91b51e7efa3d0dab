#include "sessile/surface/smooth.h"

#include <cstddef>
#include <numeric>
#include <vector>

#include "sessile/core/parallel.h"
#include "sessile/core/vec.h"
#include "sessile/surface/normals.h"

namespace sessile {
namespace {

using Points = std::vector<Vec3<float>>;

/// Of each vertex those it shares an edge with.
class Adjacency {
 public:
  explicit Adjacency(const SurfaceMesh& mesh) : begin_(mesh.vertex_count() + 2, 0), near_(mesh.triangles.size()) {
    for (const std::uint32_t v : mesh.triangles) ++begin_[v + 2];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    // A closed surface has each edge once each way: what follows v in a triangle is a neighbour, and each is met once.
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        near_[begin_[mesh.triangles[t + k] + 1]++] = mesh.triangles[t + (k + 1) % 3];
      }
    }
  }

  Vec3<float> mean(const Points& of, std::size_t v) const {
    Vec3<float> total;
    for (std::size_t k = begin_[v]; k < begin_[v + 1]; ++k) total += of[near_[k]];
    return 1 / static_cast<float>(begin_[v + 1] - begin_[v]) * total;
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> near_;
};

void relax(const Adjacency& adjacency, Points& points, Points& before, float share) {
  std::swap(points, before);
  for_each(points.size(), [&](int i) {
    const auto v = static_cast<std::size_t>(i);
    points[v] = before[v] + share * (adjacency.mean(before, v) - before[v]);
  });
}

void smooth_points(const Adjacency& adjacency, SurfaceMesh& mesh, int turns) {
  constexpr float there = 0.5f, back = -0.53f;  // keeps what is longer than some 18 edges
  Points points(mesh.vertex_count()), before(points.size());
  for_each(points.size(), [&](int i) {
    const float* x = &mesh.points[3 * static_cast<std::size_t>(i)];
    points[static_cast<std::size_t>(i)] = {x[0], x[1], x[2]};
  });
  for (int turn = 0; turn < turns; ++turn) {
    relax(adjacency, points, before, there);
    relax(adjacency, points, before, back);
  }
  for_each(points.size(), [&](int i) {
    const Vec3<float>& x = points[static_cast<std::size_t>(i)];
    float* to = &mesh.points[3 * static_cast<std::size_t>(i)];
    to[0] = x.x, to[1] = x.y, to[2] = x.z;
  });
}

void smooth_normals(const Adjacency& adjacency, SurfaceMesh& mesh, int turns) {
  Points normals(mesh.vertex_count()), before(normals.size());
  for_each(normals.size(), [&](int i) {
    const float* n = &mesh.normals[3 * static_cast<std::size_t>(i)];
    normals[static_cast<std::size_t>(i)] = {n[0], n[1], n[2]};
  });
  for (int turn = 0; turn < turns; ++turn) relax(adjacency, normals, before, 0.5f);
  for_each(normals.size(), [&](int i) {
    const Vec3<float>& n = normals[static_cast<std::size_t>(i)];
    const float norm = length(n);
    if (!(norm > 0)) return;  // its own stays
    float* to = &mesh.normals[3 * static_cast<std::size_t>(i)];
    to[0] = n.x / norm, to[1] = n.y / norm, to[2] = n.z / norm;
  });
}

}  // namespace

void smooth(SurfaceMesh& mesh, int turns, int normal_turns) {
  const Adjacency adjacency(mesh);
  if (turns > 0) smooth_points(adjacency, mesh, turns);
  mesh.normals = vertex_normals(mesh);
  if (normal_turns > 0) smooth_normals(adjacency, mesh, normal_turns);
}

}  // namespace sessile
