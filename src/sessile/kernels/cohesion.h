#pragma once

#include <cassert>
#include <numbers>

#include "sessile/core/lanes.h"

namespace sessile {

/// Cohesion spline (18), in units of 1/dx^3. Attracts beyond 0.273 h, repels below.
///   d(r) = 32/(pi h^9) { (h-r)^3 r^3 (h/2 < r <= h),  2(h-r)^3 r^3 - h^6/64 (0 < r <= h/2) }
struct CohesionSpline {
  Real inverse_h = 0;
  Real scale = 0;  // 32/pi (dx/h)^3

  CohesionSpline() = default;
  CohesionSpline(double support_radius, double spacing) {
    assert(support_radius > 0 && spacing > 0);
    const double ratio = spacing / support_radius;
    inverse_h = static_cast<Real>(1 / support_radius);
    scale = static_cast<Real>(32 / std::numbers::pi * ratio * ratio * ratio);
  }

  /// dx^3 d(r), dimensionless; 0 at r = 0 and beyond h.
  template <class T>
  T value(const T& r) const {
    assert(none_negative(r));
    const T q = r * T(inverse_h);
    const T product = q * max(T(Real(1)) - q, T(Real(0)));
    const T far = product * product * product;
    const T near = T(Real(2)) * far - T(Real(1) / 64);
    return T(scale) * select(q > T(Real(0.5)), far, select(q > T(Real(0)), near, T(Real(0))));
  }
};

}  // namespace sessile
