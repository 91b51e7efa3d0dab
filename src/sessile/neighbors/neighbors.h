#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sessile/core/array.h"
#include "sessile/core/space.h"
#include "sessile/neighbors/grid.h"

namespace sessile {

/// For each particle of one set the indices of the particles of another (or the same) set closer than the support
/// radius, strictly; itself left out. Built anew once a step. Lists are padded to whole packs of lanes.
class NeighborList {
 public:
  std::size_t size() const { return first_.size(); }
  std::span<const std::int32_t> operator[](std::size_t i) const {
    return {first_[i], static_cast<std::size_t>(count_[i])};
  }
  int count(std::size_t i) const { return count_[i]; }

  /// Finds, for every point of `points`, the points of `others` with |x_i - x_j| < radius. `grid` holds `others`.
  /// When both are the same set, `same` leaves each point out of its own list. `others` is in the order of `grid`.
  void build(const Array3& points, const Array3& others, const Grid& grid, const Space& space, Real radius, bool same);

  const std::int32_t* const* firsts() const { return first_.data(); }
  const std::int32_t* counts() const { return count_.data(); }
  std::size_t bytes() const;

 private:
  Array<const std::int32_t*> first_;
  Array<std::int32_t> count_;
  std::vector<Array<std::int32_t>> blocks_;  // each block of particles owns the memory of its lists
};

}  // namespace sessile
