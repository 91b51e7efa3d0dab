#include "sessile/surface/carry.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "sessile/core/parallel.h"

namespace sessile {
namespace {

/// What a vertex takes from the particles around it: their indices in the frame, and shares that add up to 1.
struct Shares {
  std::vector<std::pair<std::size_t, float>> of;
  std::size_t nearest = 0;
};

class CarriersAround {
 public:
  explicit CarriersAround(const Cloud& cloud) : cloud_(cloud) {}

  void find(const Vec3d& vertex, Shares& shares) {
    shares.of.clear();
    const Vec3d at = 1 / cloud_.unit * vertex;
    const double radius2 = cloud_.search_radius * cloud_.search_radius;
    double least = std::numeric_limits<double>::infinity(), total = 0;
    const auto look_at = [&](std::size_t k) {
      const double r2 = squared_length(at - vec_cast<double>(cloud_.position[k]));
      const auto particle = static_cast<std::size_t>(cloud_.grid.order()[k]);
      if (r2 < least) least = r2, shares.nearest = particle;
      if (r2 >= radius2) return;
      const double near = 1 - r2 / radius2, weight = near * near * near;
      total += weight;
      shares.of.emplace_back(particle, static_cast<float>(weight));
    };
    const auto cell = cloud_.grid.shape().cell_of(vec_cast<Real>(at));
    const int found = cloud_.grid.around(cell, cursor_, ranges_);
    for (int r = 0; r < found; ++r) {
      const PlaceRange range = ranges_[static_cast<std::size_t>(r)];
      for (auto k = range.begin; k < range.end; ++k) look_at(static_cast<std::size_t>(k));
    }
    if (least == std::numeric_limits<double>::infinity()) {  // far from all: rare enough to look everywhere
      for (std::size_t k = 0; k < cloud_.size(); ++k) look_at(k);
    }
    for (auto& share : shares.of) share.second /= static_cast<float>(total);
    if (shares.of.empty()) shares.of.emplace_back(shares.nearest, 1.f);
  }

 private:
  const Cloud& cloud_;
  Grid::Cursor cursor_;
  std::array<PlaceRange, 18> ranges_{};
};

void take(const std::vector<float>& from, std::size_t components, const Shares& shares, float* to) {
  for (std::size_t c = 0; c < components; ++c) {
    float mean = 0;
    for (const auto& [particle, share] : shares.of) mean += share * from[components * particle + c];
    to[c] = mean;
  }
}

void take(const std::vector<std::int64_t>& from, std::size_t components, const Shares& shares, std::int64_t* to) {
  std::copy_n(&from[components * shares.nearest], components, to);
}

}  // namespace

std::vector<Column> carry_columns(const Snapshot& particles, const Cloud& cloud, const SurfaceMesh& mesh) {
  std::vector<Column> carried;
  for (const Column& column : particles.columns) {
    const std::size_t size = mesh.vertex_count() * static_cast<std::size_t>(column.components);
    carried.push_back({column.name, column.unit, column.components, {}});
    carried.back().values =
        std::visit([&]<class T>(const std::vector<T>&) { return ColumnValues(std::vector<T>(size)); }, column.values);
  }
  if (carried.empty()) return carried;
  for_each_block(mesh.vertex_count(), [&](std::ptrdiff_t, std::ptrdiff_t begin, std::ptrdiff_t end) {
    CarriersAround surroundings(cloud);
    Shares shares;
    for (auto vertex = static_cast<std::size_t>(begin); vertex < static_cast<std::size_t>(end); ++vertex) {
      const float* x = &mesh.points[3 * vertex];
      surroundings.find({x[0], x[1], x[2]}, shares);
      for (std::size_t c = 0; c < carried.size(); ++c) {
        const auto components = static_cast<std::size_t>(carried[c].components);
        std::visit(
            [&]<class T>(std::vector<T>& to) {
              take(std::get<std::vector<T>>(particles.columns[c].values), components, shares, &to[components * vertex]);
            },
            carried[c].values);
      }
    }
  });
  return carried;
}

}  // namespace sessile
