#include "sessile/scene/mesh_sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "sessile/scene/lattice.h"
#include "sessile/scene/mesh_space.h"

namespace sessile {

namespace {

constexpr double least_distance = 0.86;  // over the spacing; packs about one sample per spacing^2
constexpr double widest = 1e15;          // over the spacing; cells are numbered by int64
constexpr double long_side = 100;        // over the spacing: up to here the area of a triangle tells enough
constexpr double raster = 0.25;          // over the spacing

/// Samples found so far, in cells, so that none is taken too near another.
class SampleSet {
 public:
  SampleSet(const Vec3d& origin, double distance) : origin_(origin), distance_(distance) {}

  void add_if_free(const Vec3d& point) {
    const Cell cell = cell_of(point);
    if (!free(point, cell)) return;
    next_.push_back(-1);
    const auto index = static_cast<std::int64_t>(points_.size());
    const auto [head, fresh] = heads_.emplace(cell, index);
    if (!fresh) next_.back() = std::exchange(head->second, index);
    points_.push_back(point);
  }

  bool free(const Vec3d& point) const { return free(point, cell_of(point)); }
  std::vector<Vec3d> take() { return std::move(points_); }

 private:
  struct Cell {
    std::int64_t x, y, z;
    bool operator==(const Cell&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Cell& c) const {
      const auto mix = [](std::int64_t v, std::uint64_t factor) { return static_cast<std::uint64_t>(v) * factor; };
      return mix(c.x, 0x9e3779b97f4a7c15U) ^ mix(c.y, 0xc2b2ae3d27d4eb4fU) ^ mix(c.z, 0x165667b19e3779f9U);
    }
  };

  Cell cell_of(const Vec3d& point) const {
    const auto along = [&](double p, double o) { return static_cast<std::int64_t>(std::floor((p - o) / distance_)); };
    return {along(point.x, origin_.x), along(point.y, origin_.y), along(point.z, origin_.z)};
  }

  bool free(const Vec3d& point, const Cell& cell) const {
    for (int k = 0; k < 27; ++k) {
      const auto found = heads_.find({cell.x + k % 3 - 1, cell.y + k / 3 % 3 - 1, cell.z + k / 9 - 1});
      if (found == heads_.end()) continue;
      for (auto i = found->second; i >= 0; i = next_[static_cast<std::size_t>(i)]) {
        if (squared_length(points_[static_cast<std::size_t>(i)] - point) < distance_ * distance_) return false;
      }
    }
    return true;
  }

  Vec3d origin_;
  double distance_;
  std::vector<Vec3d> points_;
  std::vector<std::int64_t> next_;  // the next sample of the same cell
  std::unordered_map<Cell, std::int64_t, Hash> heads_;
};

/// Calls f(point) on rows parallel to the triangle's longest edge. Rows and points follow the triangle's own height and
/// length, so that slivers cost little.
template <class F>
void for_each_raster_point(const Vec3d& p, const Vec3d& q, const Vec3d& r, double step, F&& f) {
  const double pq = squared_length(q - p), qr = squared_length(r - q), rp = squared_length(p - r);
  const bool pq_longest = pq >= qr && pq >= rp, qr_longest = !pq_longest && qr >= rp;
  const Vec3d &a = pq_longest ? p : qr_longest ? q : r, &b = pq_longest ? q : qr_longest ? r : p;
  const Vec3d& top = pq_longest ? r : qr_longest ? p : q;
  const double edge = std::sqrt(std::max({pq, qr, rp}));
  const double height = edge > 0 ? length(cross(b - a, top - a)) / edge : 0;
  const auto rows = static_cast<std::int64_t>(std::ceil(height / step));
  for (std::int64_t i = 0; i <= rows; ++i) {
    const double t = rows == 0 ? 0 : static_cast<double>(i) / static_cast<double>(rows);
    const Vec3d from = a + t * (top - a), to = b + t * (top - b);
    const auto columns = static_cast<std::int64_t>(std::ceil((1 - t) * edge / step));
    for (std::int64_t j = 0; j <= columns; ++j) {
      f(columns == 0 ? from : from + static_cast<double>(j) / static_cast<double>(columns) * (to - from));
    }
  }
}

}  // namespace

double estimate_mesh(const TriangleMesh& mesh, double spacing) {
  double needles = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const double edge = std::sqrt(std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)}));
    needles += std::max(0.0, edge / spacing - long_side);
  }
  return mesh.area() / spacing / spacing + needles;
}

std::vector<Vec3d> sample_mesh(const TriangleMesh& mesh, double spacing, int layers, const std::string& who) {
  check_count(estimate_mesh(mesh, spacing) * layers, who);
  const Vec3d size = mesh.upper() - mesh.lower();
  if (!(std::max({size.x, size.y, size.z}) / spacing < widest)) {
    throw SceneError(fmt::format("{}: is more than {:g} sample distances wide", who, widest));
  }
  SampleSet samples(mesh.lower(), least_distance * spacing);
  for (const auto& vertex : mesh.vertices) samples.add_if_free(vertex);
  const auto corner = [&](const auto& t, std::size_t k) { return mesh.vertices[t[k]]; };
  for (const auto& t : mesh.triangles) {
    for_each_raster_point(corner(t, 0), corner(t, 1), corner(t, 2), raster * spacing,
                          [&](const Vec3d& point) { samples.add_if_free(point); });
  }
  if (layers <= 1) return samples.take();

  if (!mesh.closed()) throw SceneError(who + ": is not closed, so it has no inside for more than one layer");
  const MeshSpace space(mesh);
  for (int k = 1; k < layers; ++k) {
    for (const auto& t : mesh.triangles) {
      const Vec3d normal = cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
      const double twice_area = length(normal);
      if (!(twice_area > 0)) continue;
      // Files do not agree on which way triangles face: a hair's breadth beside its middle tells.
      const Vec3d middle = corner(t, 0) + 1.0 / 3 * (corner(t, 1) - corner(t, 0) + corner(t, 2) - corner(t, 0));
      const Vec3d unit = 1 / twice_area * normal;
      const Vec3d beside = 1e-3 * std::min(spacing, std::sqrt(twice_area)) * unit;
      const Vec3d inwards = (space.contains(middle - beside) ? -k : k) * spacing * unit;
      for_each_raster_point(corner(t, 0), corner(t, 1), corner(t, 2), raster * spacing, [&](const Vec3d& point) {
        const Vec3d place = point + inwards;
        if (samples.free(place) && space.contains(place)) samples.add_if_free(place);
      });
    }
  }
  return samples.take();
}

}  // namespace sessile
