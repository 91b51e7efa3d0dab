#include "sessile/surface/block_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sessile/core/parallel.h"

namespace sessile {
namespace {

constexpr std::ptrdiff_t blocks_at_once = 16;  // handed to a thread

/// Calls visit(block, sums, blob, center) for every block and every blob that may reach it; the centre is in points
/// from the block's first.
template <class Sums, class Start, class Visit, class Finish>
void for_each_block_and_blob(const BlockMap& map, const Blobs& blobs, const Start& start, const Visit& visit,
                             const Finish& finish) {
  const double per_point = 1 / map.cube();
  const auto count = static_cast<std::ptrdiff_t>(map.size());
  FirstError error;
#pragma omp parallel for schedule(dynamic, 1)
  for (std::ptrdiff_t first = 0; first < count; first += blocks_at_once) {
    error.guard([&] {
      Grid::Cursor cursor;
      Sums sums;
      std::array<PlaceRange, 18> ranges;
      for (auto b = static_cast<std::size_t>(first);
           b < static_cast<std::size_t>(std::min(count, first + blocks_at_once)); ++b) {
        start(b, sums);
        const BlockPlace& place = map.place(b);
        const auto corner = [](std::int64_t at) { return static_cast<double>(at * block_edge); };
        const Vec3d origin{corner(place.x), corner(place.y), corner(place.z)};
        const auto misses = [](double at, double reach) { return at + reach < 0 || at - reach > block_edge - 1; };
        const int found = map.grid().around(map.cell(b), cursor, ranges);
        for (int r = 0; r < found; ++r) {
          const PlaceRange range = ranges[static_cast<std::size_t>(r)];
          for (auto i = static_cast<std::size_t>(range.begin); i < static_cast<std::size_t>(range.end); ++i) {
            const Blob& blob = blobs.blobs[i];
            const Vec3d at = per_point * vec_cast<double>(blobs.centers[i]) - origin;
            const Vec3d reach = per_point * vec_cast<double>(blob.reach);
            if (misses(at.x, reach.x) || misses(at.y, reach.y) || misses(at.z, reach.z)) continue;
            visit(b, sums, i, vec_cast<float>(at));
          }
        }
        finish(b, sums);
      }
    });
  }
  error.rethrow();
}

/// Adds kernel(q^2) for the points of a block that a blob reaches. `cube2` is the square of the distance of points.
template <class Add>
void visit_rows(const Blob& blob, const Vec3<float>& center, float cube, const Add& add) {
  const float cube2 = cube * cube, per_point = 1 / cube;
  const auto first = [](float at) { return std::max(0, static_cast<int>(std::ceil(at))); };
  const auto last = [](float at) { return std::min(block_edge - 1, static_cast<int>(std::floor(at))); };
  const float xx = cube2 * blob.xx, xy = cube2 * blob.xy, xz = cube2 * blob.xz;
  const float reach_y = per_point * blob.reach.y, reach_z = per_point * blob.reach.z;
  const int z_last = last(center.z + reach_z), y_last = last(center.y + reach_y);
  for (int z = first(center.z - reach_z); z <= z_last; ++z) {
    const float dz = static_cast<float>(z) - center.z;
    for (int y = first(center.y - reach_y); y <= y_last; ++y) {
      const float dy = static_cast<float>(y) - center.y;
      // q^2 along the row: xx dx^2 + 2 half dx + rest; its least value is rest - half^2 / xx.
      const float half = xy * dy + xz * dz;
      const float rest = cube2 * (blob.yy * dy * dy + 2 * blob.yz * dy * dz + blob.zz * dz * dz);
      if ((rest - 1) * xx >= half * half) continue;
      std::array<float, block_edge> q2;
      for (int x = 0; x < block_edge; ++x) {
        const float dx = static_cast<float>(x) - center.x;
        q2[static_cast<std::size_t>(x)] = rest + dx * (2 * half + xx * dx);
      }
      add(point_index(0, y, z), q2);
    }
  }
}

inline float greater(float a, float b) { return a > b ? a : b; }

}  // namespace

BlockField density_field(const BlockMap& map, const Blobs& blobs, float threshold) {
  BlockField field;
  field.blocks.resize(map.size());
  const auto cube = static_cast<float>(map.cube());
  for_each_block_and_blob<BlockValues>(
      map, blobs, [&](std::size_t, BlockValues& sums) { sums.at.fill(-threshold); },
      [&](std::size_t, BlockValues& sums, std::size_t i, const Vec3<float>& center) {
        const Blob& blob = blobs.blobs[i];
        visit_rows(blob, center, cube, [&](std::size_t row, const std::array<float, block_edge>& q2) {
          float* values = sums.at.data() + row;
          for (std::size_t x = 0; x < block_edge; ++x) {
            const float q = std::sqrt(greater(q2[x], 0));
            const float outer = greater(1 - q, 0), inner = greater(0.5f - q, 0);
            values[x] += blob.weight * (2 * outer * outer * outer - 8 * inner * inner * inner);
          }
        });
      },
      [&](std::size_t b, const BlockValues& sums) { field.blocks[b] = sums; });
  return field;
}

BlockField mean_distance_field(const BlockMap& map, const Blobs& blobs, float radius) {
  struct Sums {
    BlockValues weight, x, y, z;  // of k and of k times the displacement from the centre
  };
  static_assert(sizeof(Sums) == 4 * sizeof(BlockValues));
  BlockField field;
  field.blocks.resize(map.size());
  const auto cube = static_cast<float>(map.cube());
  for_each_block_and_blob<Sums>(
      map, blobs, [](std::size_t, Sums& sums) { sums = {}; },
      [&](std::size_t, Sums& sums, std::size_t i, const Vec3<float>& center) {
        visit_rows(blobs.blobs[i], center, cube, [&](std::size_t row, const std::array<float, block_edge>& q2) {
          const std::size_t y = row / block_edge % block_edge, z = row / (block_edge * block_edge);
          const float dy = static_cast<float>(y) - center.y, dz = static_cast<float>(z) - center.z;
          for (std::size_t x = 0; x < block_edge; ++x) {
            const float near = greater(1 - q2[x], 0), k = near * near * near;
            sums.weight.at[row + x] += k;
            sums.x.at[row + x] += k * (static_cast<float>(x) - center.x);
            sums.y.at[row + x] += k * dy;
            sums.z.at[row + x] += k * dz;
          }
        });
      },
      [&](std::size_t b, const Sums& sums) {
        for (std::size_t k = 0; k < block_points; ++k) {
          const float weight = sums.weight.at[k];
          const float distance =
              std::sqrt(sums.x.at[k] * sums.x.at[k] + sums.y.at[k] * sums.y.at[k] + sums.z.at[k] * sums.z.at[k]);
          field.blocks[b].at[k] = weight > 0 ? radius - distance / weight : -radius;
        }
      });
  return field;
}

}  // namespace sessile
