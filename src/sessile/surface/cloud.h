#pragma once

#include <span>

#include "sessile/neighbors/neighbors.h"

namespace sessile {

/// Particles in the order of their cells, in a unit of length near the particle radius: the power of two next to it,
/// so that floats neither round nor overflow on the way.
struct Cloud {
  double unit = 1;    ///< [m]
  double radius = 1;  ///< particle radius, half the spacing [unit]
  Array3 position;    ///< [unit]
  Grid grid;          ///< its cells are as long as the search radius
  NeighborList near;  ///< within the search radius
  double search_radius = 0;

  std::size_t size() const { return position.size(); }

  /// `search_radius` in particle radii. Throws Error for positions that are not finite.
  Cloud(std::span<const float> points, double spacing, double search_radius);
};

}  // namespace sessile
