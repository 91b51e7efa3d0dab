#include "sessile/neighbors/neighbors.h"

#include <algorithm>

#include "sessile/core/lanes.h"
#include "sessile/core/parallel.h"

namespace sessile {
namespace {

/// Appends to `list` the places in [range) closer than the radius to the point `self`; returns how many. Candidates of
/// a cell row are contiguous, so they load as packs.
int close_ones(const Array3& others, const PlaceRange& range, const Vec3r& point, const Space& space,
               Real squared_radius, std::int32_t self, std::int32_t* list) {
  const Vec3<Lanes> xi = spread<Lanes>(point);
  const Lanes numbers = lane_numbers();
  int found = 0;
  for (std::int32_t j = range.begin; j < range.end; j += lane_count) {
    const Vec3<Lanes> xj{Lanes::load_unaligned(others.x.data() + j), Lanes::load_unaligned(others.y.data() + j),
                         Lanes::load_unaligned(others.z.data() + j)};
    const Lanes r2 = squared_length(space.displacement(xi, xj));
    const LaneMask close = (r2 < Lanes(squared_radius)) & (numbers < Lanes(static_cast<Real>(range.end - j))) &
                           (numbers != Lanes(static_cast<Real>(self - j)));
    found += store_where(list + found, j, close);
  }
  return found;
}

}  // namespace

void NeighborList::build(const Array3& points, const Array3& others, const Grid& grid, const Space& space, Real radius,
                         bool same) {
  const std::size_t n = points.size();
  first_.resize(n);
  count_.resize(n);
  blocks_.resize(static_cast<std::size_t>(block_count(n)));
  for_each_block(n, [&](std::ptrdiff_t block, std::ptrdiff_t begin, std::ptrdiff_t end) {
    Array<std::int32_t>& memory = blocks_[static_cast<std::size_t>(block)];
    Grid::Cursor cursor;
    std::array<PlaceRange, 18> ranges;
    std::array<std::int64_t, 3> last_cell{};
    int range_count = -1;
    std::size_t candidates = 0, used = 0;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Vec3r point = points[i];
      const auto cell = grid.shape().cell_of(point);
      if (range_count < 0 || cell != last_cell) {
        range_count = grid.around(cell, cursor, ranges);
        last_cell = cell;
        candidates = 0;
        for (int k = 0; k < range_count; ++k) {
          const PlaceRange& range = ranges[static_cast<std::size_t>(k)];
          candidates += static_cast<std::size_t>(range.end - range.begin);
        }
      }
      // A pack may be written whole past the last neighbour, and the list is padded to a whole pack.
      const std::size_t needed = used + candidates + 2 * lane_count;
      if (memory.size() < needed) memory.resize(std::max(needed, memory.size() + memory.size() / 2));
      int found = 0;
      for (int k = 0; k < range_count; ++k) {
        found += close_ones(others, ranges[static_cast<std::size_t>(k)], point, space, radius * radius,
                            same ? static_cast<std::int32_t>(i) : -1, memory.data() + used + found);
      }
      const std::size_t padded = static_cast<std::size_t>((found + lane_count - 1) / lane_count) * lane_count;
      for (std::size_t k = static_cast<std::size_t>(found); k < padded; ++k) memory[used + k] = memory[used];
      count_[i] = found;
      used += padded;
    }
    // The memory may have moved while it grew: only now do addresses hold.
    std::size_t start = 0;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      first_[i] = memory.data() + start;
      start += static_cast<std::size_t>((count_[i] + lane_count - 1) / lane_count) * lane_count;
    }
  });
}

std::size_t NeighborList::bytes() const {
  std::size_t total = first_.capacity() * sizeof(first_[0]) + count_.capacity() * sizeof(count_[0]);
  for (const auto& block : blocks_) total += block.capacity() * sizeof(std::int32_t);
  return total;
}

}  // namespace sessile
