#include "sessile/neighbors/neighbors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "sessile/core/bounds.h"
#include "sessile/core/error.h"
#include "sessile/core/lanes.h"
#include "sessile/core/parallel.h"

namespace sessile {
namespace {

/// The points in the cells around one cell, side by side: every point of the cell is held against all of them.
class Candidates {
 public:
  /// `own` is where the points of the cell themselves lie, if they are candidates too.
  void collect(const Array3& points, std::span<const PlaceRange> ranges, const PlaceRange& own) {
    std::size_t room = lane_count;
    for (const PlaceRange& range : ranges) room += static_cast<std::size_t>(range.end - range.begin);
    if (place_.size() < room) {
      for (auto* array : {&x_, &y_, &z_}) array->resize(2 * room);
      place_.resize(2 * room);
    }
    count_ = 0;
    slot_of_place_0_ = std::numeric_limits<std::int32_t>::max();
    for (const PlaceRange& range : ranges) {
      if (range.begin <= own.begin && own.begin < range.end) slot_of_place_0_ = count_ - range.begin;
      // Whole packs: what lies past the range's end is written over by the next one.
      for (std::int32_t j = range.begin, k = count_; j < range.end; j += lane_count, k += lane_count) {
        Lanes::load_unaligned(points.x.data() + j).store_unaligned(x_.data() + k);
        Lanes::load_unaligned(points.y.data() + j).store_unaligned(y_.data() + k);
        Lanes::load_unaligned(points.z.data() + j).store_unaligned(z_.data() + k);
        std::int32_t* places = place_.data() + k;
        for (int lane = 0; lane < lane_count; ++lane) places[lane] = j + lane;
      }
      count_ += range.end - range.begin;
    }
    // What fills up the last pack is close to nothing.
    for (auto* array : {&x_, &y_, &z_}) {
      Lanes(std::numeric_limits<Real>::infinity()).store_unaligned(array->data() + count_);
    }
  }

  int count() const { return count_; }

  /// Writes the places closer than the radius to `list`, but for the place `self`; returns how many.
  int close_to(const Vec3r& point, const Space& space, Real squared_radius, std::int32_t self,
               std::int32_t* list) const {
    const Vec3<Lanes> xi{Lanes(point.x), Lanes(point.y), Lanes(point.z)};
    const Lanes own(
        static_cast<Real>(slot_of_place_0_ == std::numeric_limits<std::int32_t>::max() ? -1 : self + slot_of_place_0_));
    Lanes slot = lane_numbers();
    int found = 0;
    for (int k = 0; k < count_; k += lane_count) {
      const Vec3<Lanes> xj{Lanes::load_unaligned(x_.data() + k), Lanes::load_unaligned(y_.data() + k),
                           Lanes::load_unaligned(z_.data() + k)};
      const Lanes r2 = squared_length(space.displacement(xi, xj));
      found += store_where((r2 < Lanes(squared_radius)) & (slot != own), place_.data() + k, list + found);
      slot += Lanes(Real(lane_count));
    }
    return found;
  }

 private:
  int count_ = 0;
  std::int32_t slot_of_place_0_ = 0;  // slot of a point of the cell, less its place; greatest where there are none
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
      stream_entries(memory_.data(), start + min(IndexLanes(k), last), to);
    }
  }

 private:
  std::size_t used_ = 0;
  Array<std::int32_t> memory_;
  std::int32_t count_[lane_count] = {};
  LaneIndex start_[lane_count] = {};
};

/// Whether each list holds places among `others` alone, and no particle itself, for assertions.
[[maybe_unused]] bool sound(const NeighborList& lists, std::size_t others, bool same, std::size_t offset) {
  for (std::size_t i = 0; i < lists.size(); ++i) {
    for (const std::int32_t j : lists[i]) {
      if (j < 0 || static_cast<std::size_t>(j) >= others) return false;
      if (same && static_cast<std::size_t>(j) == offset + i) return false;
    }
  }
  return true;
}

}  // namespace

void refuse_crowding(std::size_t points_in_a_cell) {
  if (points_in_a_cell <= most_in_a_cell) return;
  throw RunError(
      fmt::format("{} particles crowd into one cube with an edge of the support radius, where {} are the most that "
                  "neighbours can be found for: the liquid has collapsed, which shorter steps may prevent",
                  points_in_a_cell, most_in_a_cell));
}

std::vector<PlaceRange> parts_of(std::size_t points, std::size_t fullest_cell) {
  constexpr std::size_t most_entries = std::size_t{1} << 25, cells = 27;
  const auto block = static_cast<std::size_t>(block_size);
  std::size_t size = std::max<std::size_t>(most_entries / (cells * std::max<std::size_t>(1, fullest_cell)), lane_count);
  size -= size % (size < block ? static_cast<std::size_t>(lane_count) : block);
  std::vector<PlaceRange> parts;
  for (std::size_t begin = 0; begin < points; begin += size) {
    parts.push_back({static_cast<std::int32_t>(begin), static_cast<std::int32_t>(std::min(points, begin + size))});
  }
  return parts;
}

void NeighborList::build(const SortedPoints& points, const SortedPoints& others, const Space& space, Real radius) {
  build(points, others, space, radius, {0, static_cast<std::int32_t>(points.position.size())});
}

void NeighborList::build(const SortedPoints& points, const SortedPoints& others, const Space& space, Real radius,
                         const PlaceRange& part) {
  static_assert(block_size % lane_count == 0, "a group lies in one block");
  const bool same = &points.position == &others.position;
  const auto held = [&](int cell) {
    const PlaceRange places = others.grid.places(static_cast<std::size_t>(cell));
    return static_cast<double>(places.end - places.begin);
  };
  refuse_crowding(static_cast<std::size_t>(maximum(others.grid.cell_count(), held)));
  const auto offset = static_cast<std::size_t>(part.begin);
  size_ = static_cast<std::size_t>(part.end - part.begin);
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
    std::size_t cell = points.grid.cell_at(part.begin + static_cast<std::int32_t>(begin));
    auto next_cell =
        offset + static_cast<std::size_t>(begin);  // the first point whose candidates are yet to be collected
    for (auto first = static_cast<std::size_t>(begin); first < last; first += lane_count) {
      found.clear();
      for (int q = 0; q < lane_count; ++q) {
        const std::size_t i = offset + first + static_cast<std::size_t>(q);
        if (i >= offset + last) {
          found.add_nothing(q);
          continue;
        }
        if (i == next_cell) {
          const int range_count = others.grid.around(points.grid.cell(cell), cursor, ranges);
          const PlaceRange places = points.grid.places(cell++);
          candidates.collect(others.position, {ranges.data(), static_cast<std::size_t>(range_count)},
                             same ? places : PlaceRange{-1, -1});
          next_cell = static_cast<std::size_t>(places.end);
        }
        found.add(q, candidates, points.position[i], space, radius * radius, static_cast<std::int32_t>(i));
      }
      for (int q = 0; q < lane_count; ++q) count_[first + static_cast<std::size_t>(q)] = found.count(q);
      const std::size_t needed = static_cast<std::size_t>(found.longest()) * lane_count;
      if (memory.size() < used + needed) {
        memory.reserve(
            std::max(used + needed, memory.size() + memory.size() / 8));  // else a vector takes twice as much
        memory.resize(memory.capacity());
      }
      found.write_side_by_side(memory.data() + used);
      groups_[first / lane_count].longest = found.longest();
      used += needed;
    }
    finish_streams();
    // The memory may have moved while it grew: only now do addresses hold.
    std::size_t start = 0;
    for (auto first = static_cast<std::size_t>(begin); first < last; first += lane_count) {
      NeighborGroup& group = groups_[first / lane_count];
      group.first = memory.data() + start;
      start += static_cast<std::size_t>(group.longest) * lane_count;
    }
  });
  assert(sound(*this, others.position.size(), same, offset));
}

std::size_t NeighborList::bytes() const {
  std::size_t total = bytes_of(groups_) + bytes_of(count_);
  for (const auto& block : blocks_) total += bytes_of(block);
  return total;
}

}  // namespace sessile
