#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "ceiling/ceiling.h"
#include "ceiling/repeat.h"
#include "sessile/core/array.h"
#include "sessile/core/views.h"

namespace sessile::ceiling {
namespace {

constexpr int neighbors = 32;

/// Distances in memory to the nearest points of a lattice of `points` points, rows of `edge`, nearest first.
std::array<std::int32_t, neighbors> nearest(int edge) {
  std::vector<std::pair<int, std::int32_t>> found;
  for (int z = -2; z <= 2; ++z) {
    for (int y = -2; y <= 2; ++y) {
      for (int x = -2; x <= 2; ++x) {
        if (x != 0 || y != 0 || z != 0) found.emplace_back(x * x + y * y + z * z, x + edge * (y + edge * z));
      }
    }
  }
  std::sort(found.begin(), found.end());
  std::array<std::int32_t, neighbors> offsets{};
  for (std::size_t k = 0; k < offsets.size(); ++k) offsets[k] = found[k].second;
  std::sort(offsets.begin(), offsets.end());  // a list runs in the order of memory
  return offsets;
}

}  // namespace

double gather_rate(std::size_t points, int threads, double seconds) {
  const auto offsets = nearest(static_cast<int>(std::cbrt(static_cast<double>(points))));
  const double round = seconds_a_round(threads, seconds, [&] {
    return [xy = Array<Real>(2 * points, Real(1)), z = Array<Real>(points, Real(3)), &offsets, points] {
      const IndexLanes ring(static_cast<LaneIndex>(points - 1));
      const View3 all{nullptr, nullptr, z.data(), xy.data()};
      LaneIndex numbers[lane_count];
      std::iota(numbers, numbers + lane_count, LaneIndex(0));
      Lanes sum_x(Real(0)), sum_y(Real(0)), sum_z(Real(0));
      for (std::size_t i = 0; i < points; i += static_cast<std::size_t>(lane_count)) {
        const IndexLanes group = IndexLanes::load_unaligned(numbers) + IndexLanes(static_cast<LaneIndex>(i));
        for (const std::int32_t offset : offsets) {
          const Vec3<Lanes> at = all[(group + IndexLanes(offset)) & ring];
          sum_x += at.x;
          sum_y += at.y;
          sum_z += at.z;
        }
      }
      keep(sum_x), keep(sum_y), keep(sum_z);
    };
  });
  return 3.0 * neighbors * static_cast<double>(points) * threads / (1e9 * round);
}

}  // namespace sessile::ceiling
