#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "sessile/core/array.h"
#include "sessile/core/space.h"
#include "sessile/neighbors/grid.h"

namespace sessile {

/// The neighbours of one particle, in the order in which they are summed over.
class Neighbors {
 public:
  class Iterator {
   public:
    using value_type = std::int32_t;
    using difference_type = std::ptrdiff_t;

    Iterator() = default;
    Iterator(const Neighbors& row, std::size_t k) : first_(row.first_), stride_(row.stride_), k_(k) {}
    const std::int32_t& operator*() const { return first_[k_ * stride_]; }
    Iterator& operator++() {
      ++k_;
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++k_;
      return before;
    }
    bool operator==(const Iterator& other) const { return k_ == other.k_; }

   private:
    const std::int32_t* first_ = nullptr;
    std::size_t stride_ = 1, k_ = 0;
  };

  Neighbors(const std::int32_t* first, std::size_t count, std::size_t stride)
      : first_(first), count_(count), stride_(stride) {}

  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  std::int32_t operator[](std::size_t k) const { return first_[k * stride_]; }
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, count_}; }

 private:
  const std::int32_t* first_;
  std::size_t count_, stride_;
};

/// Lists of as many successive particles as there are lanes, side by side: neighbour k of the group's particle q stands
/// at first[k * lanes + q]. So one load gives a neighbour to each particle of the group. Lists shorter than `longest`
/// go on with some valid index.
struct NeighborGroup {
  const std::int32_t* first = nullptr;
  std::int32_t longest = 0;
};

/// Throws RunError where so many points lie in one cell that lists of them would not be told apart from others.
void refuse_crowding(std::size_t points_in_a_cell);

/// Points in the order of their grid.
struct SortedPoints {
  const Array3& position;
  const Grid& grid;
};

/// Cuts points into parts whose lists take 128 MiB at most, or one group of particles where that takes more already;
/// `fullest_cell`: most points that a cell of those to be listed holds.
std::vector<PlaceRange> parts_of(std::size_t points, std::size_t fullest_cell);

/// For each particle of one set the indices of the particles of another (or the same) set closer than the support
/// radius, strictly; itself left out. Built anew once a step.
class NeighborList {
 public:
  std::size_t size() const { return size_; }
  int count(std::size_t i) const { return count_[i]; }
  Neighbors operator[](std::size_t i) const {
    const auto* const first = groups_[i / lanes_].first;  // null where nothing at all has neighbours
    return {first == nullptr ? first : first + i % lanes_, static_cast<std::size_t>(count_[i]), lanes_};
  }

  /// Finds, for every one of `points`, those of `others` with |x_i - x_j| < radius, which is at most a cell of their
  /// grids. When both are the same set, each point is left out of its own list. Throws RunError where more than
  /// most_in_a_cell points crowd into one cell.
  void build(const SortedPoints& points, const SortedPoints& others, const Space& space, Real radius);

  /// The same of some of the points, those of one of parts_of(): list k is that of point part.begin + k.
  void build(const SortedPoints& points, const SortedPoints& others, const Space& space, Real radius,
             const PlaceRange& part);

  const NeighborGroup* groups() const { return groups_.data(); }
  const std::int32_t* counts() const { return count_.data(); }  ///< 0 for places of the last group past the end
  std::size_t lanes() const { return lanes_; }                  ///< particles of a group
  std::size_t bytes() const;

 private:
  std::size_t size_ = 0, lanes_ = 1;
  Array<NeighborGroup> groups_;
  Array<std::int32_t> count_;
  std::vector<Array<std::int32_t>> blocks_;  // each block of particles owns the memory of its lists
};

}  // namespace sessile
