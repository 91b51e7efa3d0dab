#pragma once

#include <cassert>

#include "sessile/core/lanes.h"

namespace sessile {

/// Adhesion spline (23), in units of 1/dx^3.
///   y(r) = 0.01/h^5 ( -(r - 3h/4)^2 + h^2/16 ),  h/2 < r <= h, else 0
struct AdhesionSpline {
  Real inverse_h = 0;
  Real scale = 0;  // 0.01 (dx/h)^3

  AdhesionSpline() = default;
  AdhesionSpline(double support_radius, double spacing) {
    assert(support_radius > 0 && spacing > 0);
    const double ratio = spacing / support_radius;
    inverse_h = static_cast<Real>(1 / support_radius);
    scale = static_cast<Real>(0.01 * ratio * ratio * ratio);
  }

  /// dx^3 y(r), dimensionless. The parabola is negative outside its two zeros, h/2 and h.
  template <class T>
  T value(const T& r) const {
    assert(none_negative(r));
    const T q = r * T(inverse_h);
    return T(scale) * max((q - T(Real(0.5))) * (T(Real(1)) - q), T(Real(0)));
  }
};

}  // namespace sessile
