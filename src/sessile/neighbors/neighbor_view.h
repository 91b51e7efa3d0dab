#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "sessile/core/lanes.h"
#include "sessile/core/parallel.h"
#include "sessile/neighbors/neighbors.h"

namespace sessile {

/// Calls kernel(Group) for groups that hold the particles 0 ... n-1, on all threads.
template <class Kernel>
void for_each_group(std::size_t n, const Kernel& kernel) {
  static_assert(block_size % lane_count == 0, "a group lies in one block");
  check_indices(n);
  for_each_block(n, [&](std::ptrdiff_t, std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (auto i = begin; i < end; i += lane_count) kernel(Group{static_cast<int>(i)});
  });
}

/// A neighbour list as a pair law sees it: sums over the neighbours of a particle, or of a group of them, each in the
/// order of its list.
struct NeighborView {
  const NeighborGroup* groups = nullptr;
  const std::int32_t* count = nullptr;

  NeighborView() = default;
  explicit NeighborView(const NeighborList& list) : groups(list.groups()), count(list.counts()) {}

  /// Neighbour k of particle i.
  int at(int i, int k) const {
    assert(i >= 0 && k >= 0 && k < count[i]);
    return groups[i / lane_count].first[k * lane_count + i % lane_count];
  }

  /// Sum of law(j) over the neighbours j of i; law returns a number, a Vec3 or a tuple of such.
  template <class Law>
  auto sum(int i, const Law& law) const {
    decltype(law(0)) total;
    set_zero(total);
    for (int k = 0; k < count[i]; ++k) add(total, law(at(i, k)));
    return total;
  }

  /// The same for each particle of a group, in its lane. Lists that have ended are masked. Flattened: a law called
  /// rather than inlined would hand over its packs through memory.
  template <class Law>
  [[gnu::flatten]] auto sum(Group i, const Law& law) const {
    decltype(law(IndexLanes{})) total;
    set_zero(total);
    assert(i.first >= 0 && i.first % lane_count == 0);
    const NeighborGroup& group = groups[i.first / lane_count];
    assert(group.longest >= *std::max_element(count + i.first, count + i.first + lane_count));
    const Lanes counts = xsimd::to_float(load_indices(count + i.first));
    const std::int32_t* list = group.first;
    for (int k = 0; k < group.longest; ++k, list += lane_count) {
      add_where(Lanes(static_cast<Real>(k)) < counts, total, law(load_indices(list)));
    }
    return total;
  }
};

}  // namespace sessile
