#pragma once

#include <cstddef>
#include <cstdint>

#include "sessile/core/array.h"
#include "sessile/core/space.h"
#include "sessile/neighbors/neighbors.h"

namespace sessile {

/// Read-only rows of neighbour indices, one per particle, in any order; a NeighborList is one.
struct NeighborRows {
  const NeighborGroup* groups = nullptr;
  const std::int32_t* counts = nullptr;
  std::size_t lanes = 1;  ///< particles of a group

  NeighborRows() = default;
  NeighborRows(const NeighborGroup* one_each, const std::int32_t* count_of) : groups(one_each), counts(count_of) {}
  NeighborRows(const NeighborList& list) : groups(list.groups()), counts(list.counts()), lanes(list.lanes()) {}

  Neighbors operator[](std::size_t i) const {
    return {groups[i / lanes].first + i % lanes, static_cast<std::size_t>(counts[i]), lanes};
  }
};

/// What the structure of a liquid is measured from.
struct Cloud {
  const Array3& position;        ///< of the particles [m]
  const Array3& wall_position;   ///< of the solids' samples [m]
  NeighborRows fluid_neighbors;  ///< all particles closer than the support radius; itself left out
  NeighborRows wall_neighbors;   ///< all samples closer than the support radius
  Space space{};
  double spacing = 0;         ///< dx [m]
  double support_radius = 0;  ///< h [m], at least 1.5 dx
};

/// How the liquid holds together, clings and clusters.
struct Structure {
  std::int64_t loose = 0;        ///< particles with at most 4 fluid neighbours and no wall within h
  std::int64_t first_layer = 0;  ///< particles closer than 1.5 dx to a sample of a solid
  double wetted_area = 0;        ///< first-layer particles times dx^2 [m^2]
  std::int64_t held = 0;     ///< particles of pieces that hold at least one of the first layer: what clings to solids
  std::int64_t pieces = 0;   ///< sets of particles linked by distances under 1.5 dx
  double largest_share = 0;  ///< particles of the largest piece over all particles
  // Distribution over the particles of the distance to the nearest one, over dx. Without one within h it counts as h.
  double nearest_min = 0;
  double nearest_p5 = 0;      ///< 5th percentile: one in twenty is closer
  double nearest_median = 0;  ///< 50th percentile
};

/// Measures the structure of a cloud in one pass over its neighbours; all zero without particles.
/// Percentiles are the value at place floor(q (N - 1)) of the sorted distances.
Structure structure(const Cloud& cloud);

}  // namespace sessile
