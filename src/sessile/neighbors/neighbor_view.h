#pragma once

#include <algorithm>
#include <cstdint>

#include "sessile/core/lanes.h"
#include "sessile/neighbors/neighbors.h"

namespace sessile {

/// A neighbour list as a pair law sees it: sums over the neighbours of a particle.
struct NeighborView {
  const std::int32_t* const* first = nullptr;
  const std::int32_t* count = nullptr;
  bool one_lane = false;  ///< one neighbour at a time, as plain numbers: the reference that tests hold lanes against

  NeighborView() = default;
  explicit NeighborView(const NeighborList& list) : first(list.firsts()), count(list.counts()) {}

  bool none(int i) const { return count[i] == 0; }

  /// Sum over the neighbours of i of law(j), which returns a number, a Vec3 or a tuple of such, in the lanes of j.
  /// Lists are padded to whole packs, so that the last one can be gathered too; what the padding yields is masked.
  template <class Law>
  auto sum(int i, const Law& law) const {
    return one_lane ? sum_one_by_one(i, law) : sum_lanes(i, law);
  }

 private:
  template <class Law>
  auto sum_lanes(int i, const Law& law) const {
    decltype(law(IndexLanes{})) total;
    set_zero(total);
    const std::int32_t* list = first[i];
    const Lanes numbers = lane_numbers();
    for (int done = 0, n = count[i]; done < n; done += lane_count) {
      add_where(numbers < Lanes(static_cast<Real>(n - done)), total, law(load_indices(list + done)));
    }
    return add_up(total);
  }

  template <class Law>
  auto sum_one_by_one(int i, const Law& law) const {
    decltype(law(0)) total;
    set_zero(total);
    for (int k = 0; k < count[i]; ++k) add(total, law(static_cast<int>(first[i][k])));
    return total;
  }
};

}  // namespace sessile
