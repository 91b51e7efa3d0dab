#include "sessile/neighbors/neighbors.h"

#include <algorithm>

#include "sessile/core/lanes.h"
#include "sessile/core/parallel.h"

namespace sessile {
namespace {

/// The points in the cells around one cell, side by side: every point of the cell is held against all of them.
class Candidates {
 public:
  void collect(const Array3& points, std::span<const PlaceRange> ranges) {
    ranges_ = ranges;
    std::size_t n = 0;
    for (const PlaceRange& range : ranges) n += static_cast<std::size_t>(range.end - range.begin);
    count_ = static_cast<int>(n);
    x_.resize(n), y_.resize(n), z_.resize(n), place_.resize(n);
    std::size_t k = 0;
    for (const PlaceRange& range : ranges) {
      for (std::int32_t j = range.begin; j < range.end; ++j, ++k) {
        const auto place = static_cast<std::size_t>(j);
        x_[k] = points.x[place], y_[k] = points.y[place], z_[k] = points.z[place], place_[k] = j;
      }
    }
  }

  int count() const { return count_; }

  /// Writes the places closer than the radius to `list`, but for the place `self`; returns how many.
  int close_to(const Vec3r& point, const Space& space, Real squared_radius, std::int32_t self,
               std::int32_t* list) const {
    const Vec3<Lanes> xi = spread<Lanes>(point);
    const Lanes numbers = lane_numbers();
    const int own = slot_of(self);
    int found = 0;
    for (int k = 0; k < count_; k += lane_count) {
      const Vec3<Lanes> xj{Lanes::load_unaligned(x_.data() + k), Lanes::load_unaligned(y_.data() + k),
                           Lanes::load_unaligned(z_.data() + k)};
      const Lanes r2 = squared_length(space.displacement(xi, xj));
      const LaneMask close = (r2 < Lanes(squared_radius)) & (numbers < Lanes(static_cast<Real>(count_ - k))) &
                             (numbers != Lanes(static_cast<Real>(own - k)));
      found += store_where(close, place_.data() + k, list + found);
    }
    return found;
  }

 private:
  /// Where a place stands among the candidates, or -1.
  int slot_of(std::int32_t place) const {
    int before = 0;
    for (const PlaceRange& range : ranges_) {
      if (place >= range.begin && place < range.end) return before + (place - range.begin);
      before += range.end - range.begin;
    }
    return -1;
  }

  std::span<const PlaceRange> ranges_;
  int count_ = 0;
  Array<Real> x_, y_, z_;
  Array<std::int32_t> place_;
};

constexpr std::size_t padded(std::size_t count) { return (count + lane_count - 1) / lane_count * lane_count; }

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
    Candidates candidates;
    std::array<PlaceRange, 18> ranges;
    std::array<std::int64_t, 3> last_cell{};
    std::size_t used = 0;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Vec3r point = points[i];
      const auto cell = grid.shape().cell_of(point);
      if (i == static_cast<std::size_t>(begin) || cell != last_cell) {
        const int range_count = grid.around(cell, cursor, ranges);
        candidates.collect(others, {ranges.data(), static_cast<std::size_t>(range_count)});
        last_cell = cell;
      }
      // A pack may be written whole past the last neighbour, and the list is padded to a whole pack.
      const std::size_t needed = used + static_cast<std::size_t>(candidates.count()) + 2 * lane_count;
      if (memory.size() < needed) memory.resize(std::max(needed, memory.size() + memory.size() / 2));
      std::int32_t* list = memory.data() + used;
      const int found =
          candidates.close_to(point, space, radius * radius, same ? static_cast<std::int32_t>(i) : -1, list);
      const auto count = static_cast<std::size_t>(found);
      std::fill(list + count, list + padded(count), list[0]);
      count_[i] = found;
      used += padded(count);
    }
    // The memory may have moved while it grew: only now do addresses hold.
    std::size_t start = 0;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      first_[i] = memory.data() + start;
      start += padded(static_cast<std::size_t>(count_[i]));
    }
  });
}

std::size_t NeighborList::bytes() const {
  std::size_t total = first_.capacity() * sizeof(first_[0]) + count_.capacity() * sizeof(count_[0]);
  for (const auto& block : blocks_) total += block.capacity() * sizeof(std::int32_t);
  return total;
}

}  // namespace sessile
