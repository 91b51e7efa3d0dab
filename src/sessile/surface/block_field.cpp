#include "sessile/surface/block_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sessile/core/parallel.h"

namespace sessile {
namespace {

constexpr std::ptrdiff_t blocks_at_once = 16;  // handed to a thread

/// Calls visit(block, blob, center) for every block and every blob that may reach it; centre and, by `to_points`, the
/// blob's lengths are in points from the block's first.
template <class Start, class Visit, class Finish>
void for_each_block_and_blob(const BlockMap& map, const Blobs& blobs, const Start& start, const Visit& visit,
                             const Finish& finish) {
  const double per_point = 1 / map.cube();
  const auto count = static_cast<std::ptrdiff_t>(map.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::ptrdiff_t first = 0; first < count; first += blocks_at_once) {
    Grid::Cursor cursor;
    std::array<PlaceRange, 18> ranges;
    for (auto b = static_cast<std::size_t>(first);
         b < static_cast<std::size_t>(std::min(count, first + blocks_at_once)); ++b) {
      start(b);
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
          visit(b, i, vec_cast<float>(at));
        }
      }
      finish(b);
    }
  }
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
      add(block_edge * (block_edge * z + y), q2);
    }
  }
}

inline float greater(float a, float b) { return a > b ? a : b; }

}  // namespace

BlockField spline_field(const BlockMap& map, const Blobs& blobs, float threshold) {
  BlockField field;
  field.blocks.resize(map.size());
  const auto cube = static_cast<float>(map.cube());
  for_each_block_and_blob(
      map, blobs, [&](std::size_t b) { field.blocks[b].at.fill(-threshold); },
      [&](std::size_t b, std::size_t i, const Vec3<float>& center) {
        const Blob& blob = blobs.blobs[i];
        visit_rows(blob, center, cube, [&](int row, const std::array<float, block_edge>& q2) {
          float* values = field.blocks[b].at.data() + row;
          for (std::size_t x = 0; x < block_edge; ++x) {
            const float q = std::sqrt(greater(q2[x], 0));
            const float outer = greater(1 - q, 0), inner = greater(0.5f - q, 0);
            values[x] += blob.weight * (2 * outer * outer * outer - 8 * inner * inner * inner);
          }
        });
      },
      [](std::size_t) {});
  return field;
}

}  // namespace sessile
