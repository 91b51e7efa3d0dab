#pragma once

#include <cassert>
#include <numbers>

#include "sessile/core/lanes.h"

namespace sessile {

/// Cubic spline kernel with compact support h, in units of 1/dx^3: multiplied by masses in units of rho0 dx^3 it gives
/// densities in units of rho0, and no factor leaves float's range at any scale.
///   W(r) = 8/(pi h^3) { 6q^3 - 6q^2 + 1 (q <= 1/2),  2(1-q)^3 (q <= 1) },  q = r/h
struct CubicSpline {
  Real inverse_h = 0;
  Real scale = 0;           // 8/pi (dx/h)^3
  Real gradient_scale = 0;  // 8/pi (dx/h)^3 / h^2 [1/m^2]

  CubicSpline() = default;
  CubicSpline(double support_radius, double spacing) {
    assert(support_radius > 0 && spacing > 0);
    const double ratio = spacing / support_radius;
    const double sigma = 8 / std::numbers::pi * ratio * ratio * ratio;
    inverse_h = static_cast<Real>(1 / support_radius);
    scale = static_cast<Real>(sigma);
    gradient_scale = static_cast<Real>(sigma / (support_radius * support_radius));
  }

  /// dx^3 W(r), dimensionless. Both pieces at once: 2(1-q)^3 - 8(1/2-q)^3, cut off below 0.
  template <class T>
  T value(const T& r) const {
    assert(none_negative(r));
    const T q = r * T(inverse_h);
    const T outer = max(T(Real(1)) - q, T(Real(0)));
    const T inner = max(T(Real(0.5)) - q, T(Real(0)));
    return T(scale) * (T(Real(2)) * outer * outer * outer - T(Real(8)) * inner * inner * inner);
  }

  /// dx^3 W(0).
  Real at_zero() const { return scale; }

  /// dx^3 W'(r)/r [1/m^2]; times x_ij it is the gradient. Finite at r = 0, where the gradient is 0.
  template <class T>
  T slope_over_r(const Separation<T>& pair) const {
    assert(none_negative(pair.r));
    const T q = pair.r * T(inverse_h);
    const T rest = max(T(Real(1)) - q, T(Real(0)));
    const T inner = T(Real(18)) * q - T(Real(12));
    const T outer = T(-6 / inverse_h) * rest * rest * pair.inverse_r;
    return T(gradient_scale) * select(q <= T(Real(0.5)), inner, outer);
  }

  /// dx^3 (W'' + 2 W'/r) [1/m^2]; 0 at h/2, negative below.
  template <class T>
  T laplacian(const Separation<T>& pair) const {
    assert(none_negative(pair.r));
    const T q = pair.r * T(inverse_h);
    const T rest = max(T(Real(1)) - q, T(Real(0)));
    const T inner = T(Real(72)) * q - T(Real(36));
    const T outer = T(Real(12)) * rest * (T(Real(2)) - T(1 / inverse_h) * pair.inverse_r);
    return T(gradient_scale) * select(q <= T(Real(0.5)), inner, outer);
  }

  /// dx^3 times the Laplacian at r = 0 [1/m^2].
  Real laplacian_at_zero() const { return -36 * gradient_scale; }

  /// dx^3 grad_i W(x_i - x_j) [1/m].
  template <class T>
  Vec3<T> gradient(const Separation<T>& pair) const {
    return slope_over_r(pair) * pair.d;
  }
};

}  // namespace sessile
