#pragma once

#include <cmath>

#include "sessile/core/vec.h"

namespace sessile {

/// Space in which displacements are taken: unbounded, or periodic along some axes (nearest image).
struct Space {
  Vec3r period{};          ///< length of the period [m]; 0 along an axis that is not periodic
  Vec3r inverse_period{};  ///< its inverse, or 0
  bool periodic = false;   ///< whether any axis is

  /// x_i - x_j [m], from the image of j nearest to i. T is a number or a pack of lanes.
  template <class T>
  Vec3<T> displacement(const Vec3<T>& xi, const Vec3<T>& xj) const {
    using std::nearbyint;
    Vec3<T> d = xi - xj;
    if (periodic) {
      d.x -= T(period.x) * nearbyint(d.x * T(inverse_period.x));
      d.y -= T(period.y) * nearbyint(d.y * T(inverse_period.y));
      d.z -= T(period.z) * nearbyint(d.z * T(inverse_period.z));
    }
    return d;
  }
};

}  // namespace sessile
