#include "sessile/surface/manifold.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace sessile {
namespace {

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

/// The directed edges of all triangles, sorted.
std::vector<DirectedEdge> directed_edges(const SurfaceMesh& mesh) {
  std::vector<DirectedEdge> edges;
  edges.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(mesh.triangles[t + k], mesh.triangles[t + (k + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Edges of which there is not exactly one each way.
std::size_t count_bad_edges(const std::vector<DirectedEdge>& edges) {
  std::size_t bad = 0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const DirectedEdge back{edges[k].second, edges[k].first};
    const auto [first, last] = std::equal_range(edges.begin(), edges.end(), back);
    const bool repeated = k > 0 && edges[k] == edges[k - 1];
    bad += repeated || last - first != 1 || edges[k].first == edges[k].second;
  }
  return bad;
}

/// The triangles around each vertex as directed edges opposite to it: those of vertex v from begin[v] to begin[v + 1].
struct Links {
  std::vector<std::size_t> begin;
  std::vector<DirectedEdge> edges;

  explicit Links(const SurfaceMesh& mesh) : begin(mesh.vertex_count() + 2, 0), edges(mesh.triangles.size()) {
    for (const std::uint32_t v : mesh.triangles) ++begin[v + 2];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        edges[begin[mesh.triangles[t + k] + 1]++] = {mesh.triangles[t + (k + 1) % 3], mesh.triangles[t + (k + 2) % 3]};
      }
    }
  }

  /// Whether the triangles of a vertex make one ring.
  bool ring(std::size_t v) const {
    const auto first = edges.begin() + static_cast<std::ptrdiff_t>(begin[v]);
    const auto last = edges.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]);
    if (first == last) return false;
    std::uint32_t at = first->second;
    std::ptrdiff_t steps = 1;
    for (; at != first->first && steps <= last - first; ++steps) {
      const auto next = std::find_if(first, last, [&](const DirectedEdge& e) { return e.first == at; });
      if (next == last) return false;
      at = next->second;
    }
    return steps == last - first;
  }
};

std::size_t count_pieces(const SurfaceMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertex_count());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    for (std::size_t k = 1; k < 3; ++k) parent[root(mesh.triangles[t + k])] = root(mesh.triangles[t]);
  }
  std::size_t pieces = 0;
  for (std::uint32_t v = 0; v < parent.size(); ++v) pieces += parent[v] == v;
  return pieces;
}

}  // namespace

std::vector<std::uint32_t> bad_vertices(const SurfaceMesh& mesh) {
  std::vector<std::uint32_t> bad;
  const Links links(mesh);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!links.ring(v)) bad.push_back(v);
  }
  return bad;
}

MeshReport inspect(const SurfaceMesh& mesh) {
  MeshReport report;
  const auto edges = directed_edges(mesh);
  report.bad_edges = count_bad_edges(edges);
  report.bad_vertices = bad_vertices(mesh).size();
  const auto count_infinite = [](const std::vector<float>& numbers) {
    return static_cast<std::size_t>(
        std::count_if(numbers.begin(), numbers.end(), [](float x) { return !std::isfinite(x); }));
  };
  report.bad_points = count_infinite(mesh.points) + count_infinite(mesh.normals);
  report.pieces = count_pieces(mesh);
  report.euler = static_cast<std::ptrdiff_t>(mesh.vertex_count()) - static_cast<std::ptrdiff_t>(edges.size() / 2) +
                 static_cast<std::ptrdiff_t>(mesh.triangle_count());
  return report;
}

}  // namespace sessile
