#include "sessile/neighbors/neighbors.h"

#include <algorithm>
#include <limits>
#include <numeric>

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
    if (x_.size() < n + lane_count) {
      for (auto* array : {&x_, &y_, &z_}) array->resize(2 * n + lane_count);
      place_.resize(2 * n + lane_count);
    }
    Real* to = x_.data();
    for (const PlaceRange& range : ranges) {
      const auto at = to - x_.data();
      copy(points.x.data(), range, x_.data() + at);
      copy(points.y.data(), range, y_.data() + at);
      copy(points.z.data(), range, z_.data() + at);
      std::iota(place_.data() + at, place_.data() + at + (range.end - range.begin), range.begin);
      to += range.end - range.begin;
    }
    // What fills up the last pack is close to nothing.
    std::fill(to, to + lane_count, std::numeric_limits<Real>::infinity());
  }

  int count() const { return count_; }

  /// Writes the places closer than the radius to `list`, but for the place `self`; returns how many.
  int close_to(const Vec3r& point, const Space& space, Real squared_radius, std::int32_t self,
               std::int32_t* list) const {
    const Vec3<Lanes> xi{Lanes(point.x), Lanes(point.y), Lanes(point.z)};
    const Lanes numbers = lane_numbers();
    const int own = slot_of(self);
    int found = 0;
    for (int k = 0; k < count_; k += lane_count) {
      const Vec3<Lanes> xj{Lanes::load_unaligned(x_.data() + k), Lanes::load_unaligned(y_.data() + k),
                           Lanes::load_unaligned(z_.data() + k)};
      const Lanes r2 = squared_length(space.displacement(xi, xj));
      const LaneMask close = (r2 < Lanes(squared_radius)) & (numbers != Lanes(static_cast<Real>(own - k)));
      found += store_where(close, place_.data() + k, list + found);
    }
    return found;
  }

 private:
  /// May read and write up to a pack past the range's end.
  static void copy(const Real* from, const PlaceRange& range, Real* to) {
    for (std::int32_t j = range.begin; j < range.end; j += lane_count, to += lane_count) {
      Lanes::load_unaligned(from + j).store_unaligned(to);
    }
  }

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

/// Lists of the particles of one group, one after the other.
class Found {
 public:
  void clear() { used_ = 0; }

  /// Appends the list of the group's particle q.
  void add(int q, const Candidates& candidates, const Vec3r& point, const Space& space, Real squared_radius,
           std::int32_t self) {
    // A pack may be written whole past the last neighbour.
    const std::size_t needed = used_ + static_cast<std::size_t>(candidates.count()) + lane_count;
    if (memory_.size() < needed) memory_.resize(2 * needed);
    std::int32_t* list = memory_.data() + used_;
    count_[q] = candidates.close_to(point, space, squared_radius, self, list);
    if (count_[q] == 0) list[0] = 0;  // any valid index
    start_[q] = static_cast<LaneIndex>(used_);
    used_ += static_cast<std::size_t>(std::max(count_[q], 1));
  }
  void add_nothing(int q) {
    count_[q] = 0;
    start_[q] = 0;
  }

  int count(int q) const { return count_[q]; }
  std::int32_t longest() const { return *std::max_element(count_, count_ + lane_count); }

  /// Writes the lists side by side; a list that has ended repeats its last neighbour.
  void write_side_by_side(std::int32_t* to) const {
    const IndexLanes start = IndexLanes::load_unaligned(start_);
    const IndexLanes last = max(load_indices(count_) - IndexLanes(1), IndexLanes(0));
    const std::int32_t rows = longest();
    for (std::int32_t k = 0; k < rows; ++k, to += lane_count) {
      copy_entries(memory_.data(), start + min(IndexLanes(k), last), to);
    }
  }

 private:
  std::size_t used_ = 0;
  Array<std::int32_t> memory_;
  std::int32_t count_[lane_count] = {};
  LaneIndex start_[lane_count] = {};
};

}  // namespace

void NeighborList::build(const SortedPoints& points, const SortedPoints& others, const Space& space, Real radius) {
  static_assert(block_size % lane_count == 0, "a group lies in one block");
  const bool same = &points.position == &others.position;
  size_ = points.position.size();
  lanes_ = lane_count;
  const std::size_t group_count = (size_ + lane_count - 1) / lane_count;
  groups_.resize(group_count);
  count_.resize(group_count * lane_count);
  blocks_.resize(static_cast<std::size_t>(block_count(size_)));
  for_each_block(size_, [&](std::ptrdiff_t block, std::ptrdiff_t begin, std::ptrdiff_t end) {
    Array<std::int32_t>& memory = blocks_[static_cast<std::size_t>(block)];
    Grid::Cursor cursor;
    Candidates candidates;
    Found found;
    std::array<PlaceRange, 18> ranges;
    std::size_t used = 0;
    const auto last = static_cast<std::size_t>(end);
    std::size_t cell = points.grid.cell_at(static_cast<std::int32_t>(begin));
    auto next_cell = static_cast<std::size_t>(begin);  // the first point whose candidates are yet to be collected
    for (auto first = static_cast<std::size_t>(begin); first < last; first += lane_count) {
      found.clear();
      for (int q = 0; q < lane_count; ++q) {
        const std::size_t i = first + static_cast<std::size_t>(q);
        if (i >= last) {
          found.add_nothing(q);
          continue;
        }
        if (i == next_cell) {
          const int range_count = others.grid.around(points.grid.cell(cell), cursor, ranges);
          candidates.collect(others.position, {ranges.data(), static_cast<std::size_t>(range_count)});
          next_cell = static_cast<std::size_t>(points.grid.places(cell++).end);
        }
        found.add(q, candidates, points.position[i], space, radius * radius, same ? static_cast<std::int32_t>(i) : -1);
      }
      for (int q = 0; q < lane_count; ++q) count_[first + static_cast<std::size_t>(q)] = found.count(q);
      const std::size_t needed = static_cast<std::size_t>(found.longest()) * lane_count;
      if (memory.size() < used + needed) memory.resize(std::max(used + needed, memory.size() + memory.size() / 4));
      found.write_side_by_side(memory.data() + used);
      groups_[first / lane_count].longest = found.longest();
      used += needed;
    }
    // The memory may have moved while it grew: only now do addresses hold.
    std::size_t start = 0;
    for (auto first = static_cast<std::size_t>(begin); first < last; first += lane_count) {
      NeighborGroup& group = groups_[first / lane_count];
      group.first = memory.data() + start;
      start += static_cast<std::size_t>(group.longest) * lane_count;
    }
  });
}

std::size_t NeighborList::bytes() const {
  std::size_t total = groups_.capacity() * sizeof(groups_[0]) + count_.capacity() * sizeof(count_[0]);
  for (const auto& block : blocks_) total += block.capacity() * sizeof(std::int32_t);
  return total;
}

}  // namespace sessile
