#include "sessile/surface/decimate.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "sessile/core/first_error.h"
#include "sessile/surface/manifold.h"

namespace sessile {
namespace {

using Indices = std::vector<std::uint32_t>;
constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

/// For each vertex the least vertex of those that it is connected with.
Indices first_connected(const SurfaceMesh& mesh) {
  Indices first(mesh.vertex_count());
  std::iota(first.begin(), first.end(), 0);
  const auto root = [&](std::uint32_t v) {
    while (first[v] != v) v = first[v] = first[first[v]];
    return v;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    for (std::size_t k = 1; k < 3; ++k) {
      const std::uint32_t a = root(mesh.triangles[t]), b = root(mesh.triangles[t + k]);
      first[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::uint32_t v = 0; v < first.size(); ++v) first[v] = first[first[v]];  // those before it are done
  return first;
}

/// The connected pieces of a mesh, each on its own: whatever is measured by a piece's extent, or rounded by it, does
/// not feel how far apart pieces are.
class Pieces {
 public:
  explicit Pieces(const SurfaceMesh& mesh) : mesh_(mesh), rank_(mesh.vertex_count()) {
    Indices piece = first_connected(mesh);
    std::uint32_t count = 0;
    for (std::uint32_t v = 0; v < piece.size(); ++v) piece[v] = piece[v] == v ? count++ : piece[piece[v]];
    const auto piece_of_vertex = [&](std::size_t v) { return piece[v]; };
    const auto piece_of_triangle = [&](std::size_t t) { return piece[mesh.triangles[3 * t]]; };
    sort(vertices_, first_vertex_, count, mesh.vertex_count(), piece_of_vertex);
    sort(triangles_, first_triangle_, count, mesh.triangle_count(), piece_of_triangle);
    for (std::uint32_t p = 0; p < count; ++p) {
      for (std::size_t k = first_vertex_[p]; k < first_vertex_[p + 1]; ++k) {
        rank_[vertices_[k]] = static_cast<std::uint32_t>(k - first_vertex_[p]);
      }
    }
  }

  std::size_t size() const { return first_vertex_.size() - 1; }

  /// A piece's places and triangles.
  SurfaceMesh at(std::size_t p) const {
    SurfaceMesh piece;
    for (std::size_t k = first_vertex_[p]; k < first_vertex_[p + 1]; ++k) {
      const float* x = &mesh_.points[3 * std::size_t{vertices_[k]}];
      piece.points.insert(piece.points.end(), x, x + 3);
    }
    for (std::size_t k = first_triangle_[p]; k < first_triangle_[p + 1]; ++k) {
      const std::uint32_t* corners = &mesh_.triangles[3 * std::size_t{triangles_[k]}];
      for (int c = 0; c < 3; ++c) piece.triangles.push_back(rank_[corners[c]]);
    }
    return piece;
  }

  /// The whole mesh's number of a piece's vertex.
  std::uint32_t vertex(std::size_t p, std::uint32_t v) const { return vertices_[first_vertex_[p] + v]; }

 private:
  /// Numbers 0 ... n-1 by their piece; those of piece p from first[p] to first[p + 1].
  template <class PieceOf>
  static void sort(Indices& numbers, std::vector<std::size_t>& first, std::size_t pieces, std::size_t n,
                   const PieceOf& piece_of) {
    numbers.resize(n);
    first.assign(pieces + 2, 0);
    for (std::size_t k = 0; k < n; ++k) ++first[piece_of(k) + 2];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (std::size_t k = 0; k < n; ++k) numbers[first[piece_of(k) + 1]++] = static_cast<std::uint32_t>(k);
    first.pop_back();
  }

  const SurfaceMesh& mesh_;
  Indices vertices_, triangles_, rank_;
  std::vector<std::size_t> first_vertex_, first_triangle_;
};

/// Takes the vertices out that no triangle has. Numbers of those that stay, in their order.
Indices drop_unused(SurfaceMesh& mesh) {
  std::vector<char> used(mesh.vertex_count(), 0);
  for (const std::uint32_t v : mesh.triangles) used[v] = 1;
  Indices kept, number(used.size(), no_vertex);
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0) continue;
    number[v] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(v);
  }
  for (std::uint32_t& v : mesh.triangles) v = number[v];
  for (std::vector<float>* values : {&mesh.points, &mesh.normals}) {
    if (values->empty()) continue;
    for (std::size_t k = 0; k < kept.size(); ++k) {
      std::copy_n(values->begin() + 3 * std::ptrdiff_t{kept[k]}, 3,
                  values->begin() + 3 * static_cast<std::ptrdiff_t>(k));
    }
    values->resize(3 * kept.size());
  }
  return kept;
}

/// One piece on its way to fewer triangles.
class Decimation {
 public:
  explicit Decimation(SurfaceMesh piece)
      : piece_(std::move(piece)), report_(inspect(piece_)), volume_(enclosed_volume(piece_)) {
    held_.resize(piece_.vertex_count(), 0);
  }

  /// The triangles that are left.
  Indices run(double share, double error) {
    constexpr int tries = 16;
    for (int k = 0; k < tries; ++k) {
      SurfaceMesh fewer;
      fewer.points = piece_.points;
      fewer.triangles = simplified(share, error);
      Indices triangles = fewer.triangles;
      const Indices kept = drop_unused(fewer);
      const Indices bad = bad_vertices(fewer);
      if (bad.empty() && is_like(fewer)) return triangles;
      // Collapses glue sheets together that meet in an edge then. There are few such places: they stay as they are.
      for (const std::uint32_t v : bad) held_[kept[v]] = 1;
      if (bad.empty()) {
        share /= 1.5;
        error /= 2;
      } else {
        hold_neighbours(2 + k);
      }
    }
    return std::move(piece_.triangles);
  }

 private:
  /// The triangles with up to `share` of them taken out, but those at vertices that are held.
  Indices simplified(double share, double error) const {
    constexpr std::size_t stride = 3 * sizeof(float);
    Indices same, from;
    for (std::size_t t = 0; t < piece_.triangles.size(); t += 3) {
      const std::uint32_t* corners = &piece_.triangles[t];
      const bool held = (held_[corners[0]] | held_[corners[1]] | held_[corners[2]]) != 0;
      Indices& to = held ? same : from;
      to.insert(to.end(), corners, corners + 3);
    }
    const double extent = meshopt_simplifyScale(piece_.points.data(), piece_.vertex_count(), stride);
    const auto wanted = static_cast<std::size_t>((1 - share) * static_cast<double>(piece_.triangle_count()));
    const std::size_t target = 3 * wanted > same.size() ? 3 * wanted - same.size() : 0;
    Indices left(from.size());
    left.resize(meshopt_simplify(left.data(), from.data(), from.size(), piece_.points.data(), piece_.vertex_count(),
                                 stride, target, static_cast<float>(error / extent), meshopt_SimplifyLockBorder,
                                 nullptr));
    left.insert(left.end(), same.begin(), same.end());
    return left;
  }

  /// Whether a surface without bad vertices has the holes and the volume of the piece.
  bool is_like(const SurfaceMesh& fewer) const {
    constexpr double allowed = 0.02;
    const MeshReport report = inspect(fewer);
    return report.closed_manifold() && report.pieces == report_.pieces && report.euler == report_.euler &&
           std::abs(enclosed_volume(fewer) - volume_) <= allowed * std::abs(volume_);
  }

  void hold_neighbours(int rings) {
    for (int ring = 0; ring < rings; ++ring) {
      const std::vector<char> before = held_;
      for (std::size_t t = 0; t < piece_.triangles.size(); t += 3) {
        const std::uint32_t* corners = &piece_.triangles[t];
        if ((before[corners[0]] | before[corners[1]] | before[corners[2]]) == 0) continue;
        for (int c = 0; c < 3; ++c) held_[corners[c]] = 1;
      }
    }
  }

  SurfaceMesh piece_;
  const MeshReport report_;
  const double volume_;
  std::vector<char> held_;
};

}  // namespace

void decimate(SurfaceMesh& mesh, double share, double error) {
  if (!(share > 0) || mesh.triangles.empty()) return;
  const Pieces pieces(mesh);
  std::vector<Indices> fewer(pieces.size());
  const auto count = static_cast<std::ptrdiff_t>(pieces.size());
  FirstError fault;
#pragma omp parallel for schedule(dynamic, 1)
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const auto p = static_cast<std::size_t>(k);
    fault.guard([&] { fewer[p] = Decimation(pieces.at(p)).run(share, error); });
  }
  fault.rethrow();
  Indices triangles;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    for (const std::uint32_t v : fewer[p]) triangles.push_back(pieces.vertex(p, v));
  }
  mesh.triangles = std::move(triangles);
  drop_unused(mesh);
}

}  // namespace sessile
