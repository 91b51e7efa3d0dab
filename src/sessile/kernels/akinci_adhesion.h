#pragma once

#include <cassert>

#include "sessile/core/lanes.h"

namespace sessile {

/// Adhesion spline of Akinci et al. 2013, in units of 1/dx^3. Greatest at 3h/4: 0.00495/h^3.
///   A(r) = 0.007/h^3.25 ( -4 r^2/h + 6r - 2h )^(1/4),  h/2 < r <= h, else 0
struct AkinciAdhesionSpline {
  Real inverse_h = 0;
  Real scale = 0;  // 0.007 (dx/h)^3

  AkinciAdhesionSpline() = default;
  AkinciAdhesionSpline(double support_radius, double spacing) {
    assert(support_radius > 0 && spacing > 0);
    const double ratio = spacing / support_radius;
    inverse_h = static_cast<Real>(1 / support_radius);
    scale = static_cast<Real>(0.007 * ratio * ratio * ratio);
  }

  /// dx^3 A(r), dimensionless. The radicand over h is 2(2q - 1)(1 - q), negative outside its zeros h/2 and h. Cut off
  /// at 0, as rounding too can take it below near r = h: its root would be NaN.
  template <class T>
  T value(const T& r) const {
    assert(none_negative(r));
    const T q = r * T(inverse_h);
    const T radicand = (T(Real(4)) * q - T(Real(2))) * (T(Real(1)) - q);
    return T(scale) * sqrt(sqrt(max(radicand, T(Real(0)))));
  }
};

}  // namespace sessile
