#include "sessile/pressure/conjugate.h"

#include <algorithm>
#include <limits>

namespace sessile {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// <x, A x> over the sum of |a_ii| x_i^2 that rounding alone can make: such pressures push nothing. They are alike
/// everywhere in a liquid without a surface, where no pressure can mend the density; 3e3 eps^2 was seen there. Of a
/// column it is about the square of h over its depth.
constexpr double rounding = 1e5 * std::numeric_limits<Real>::epsilon() * std::numeric_limits<Real>::epsilon();

/// The state of a solve: pressures p with their acceleration a and residual r, and the last direction d.
struct Conjugate {
  const StepView& s;
  double dt;
  Array<Real>& p;
  PressureScratch& scratch;
  Array3& a = scratch.acceleration;
  Array<Real>& r = scratch.residual;
  Array<Real>& d = scratch.direction;
  Array3& a_of_d = scratch.direction_acceleration;
  double length = 1;     ///< l
  double curvature = 0;  ///< <d, A d>
  double z_change = 0;   ///< <z, change of r by the last turn> = -t <z, A d>
  double step = 0;       ///< t

  /// m_i/rho_i^2: <x, y> of a pressure and a density is the sum of this times both.
  double weight(int i) const { return static_cast<double>(s.m[i] / (s.rho[i] * s.rho[i])); }

  /// <u, A u> of the pressures whose acceleration this is.
  double squares(const Array3& acceleration) const {
    return dt * dt * sum(s.n, [&](int i) {
             return static_cast<double>(s.m[i]) * squared_length(vec_cast<double>(acceleration[at(i)]));
           });
  }

  /// Whether pressures x push, where <x, A x> is `squared`, or rounding is all there is to it.
  bool push(const Array<Real>& x, double squared) const {
    const double scale = sum(s.n, [&](int i) {
      const auto value = static_cast<double>(x[at(i)]);
      return weight(i) * -static_cast<double>(scratch.diagonal[at(i)]) * value * value;
    });
    return squared > rounding * scale;
  }

  Real z(int i) const {
    const bool held = p[at(i)] <= 0 && r[at(i)] < 0;
    return held || !(scratch.diagonal[at(i)] < 0) ? Real(0) : r[at(i)] / -scratch.diagonal[at(i)];
  }

  void start() {
    r.resize(s.n);
    d.assign(s.n, 0);
    for_each(s.n, [&](int i) {
      if (!(scratch.diagonal[at(i)] < 0)) p[at(i)] = 0;
    });
    pressure_acceleration(s, p, scratch.stress, a);
    const double resistance = squares(a);
    if (!push(p, resistance)) return;
    const double asked = sum(s.n, [&](int i) {
      return weight(i) * static_cast<double>(p[at(i)]) * (static_cast<double>(scratch.advected[at(i)]) - 1);
    });
    const auto best = static_cast<Real>(std::max(0.0, asked / resistance));
    for_each(s.n, [&](int i) {
      p[at(i)] *= best;
      a.set(at(i), best * a[at(i)]);
    });
  }

  /// r, its error, and what it changed by along the z it leads to.
  void measure(PressureResult& result) {
    density_change(s, a, dt, scratch.change);
    Array<Real>& before = scratch.next;
    before.swap(r);
    r.resize(s.n);
    measure_error(
        s.n,
        [&](int i) {
          r[at(i)] = scratch.advected[at(i)] + scratch.change[at(i)] - 1;
          return max(r[at(i)], Real(0));
        },
        result);
    if (result.iterations == 0) return;
    z_change = sum(s.n, [&](int i) {
      return weight(i) * static_cast<double>(z(i)) *
             (static_cast<double>(r[at(i)]) - static_cast<double>(before[at(i)]));
    });
  }

  /// Puts the next direction in the place of the last, and gives <d, r>.
  double turn(double beta) {
    const auto l = static_cast<Real>(length), share = static_cast<Real>(beta);
    return sum(s.n, [&](int i) {
      d[at(i)] = max(p[at(i)] + l * (z(i) + share * d[at(i)]), Real(0)) - p[at(i)];
      return weight(i) * static_cast<double>(d[at(i)]) * static_cast<double>(r[at(i)]);
    });
  }

  /// One turn; false when there is no direction that improves anything.
  bool improve() {
    double slope = curvature > 0 ? turn(std::max(0.0, z_change / (step * curvature))) : turn(0);
    if (!(slope > 0)) slope = turn(0);
    pressure_acceleration(s, d, scratch.stress, a_of_d);
    curvature = squares(a_of_d);
    if (!(slope > 0) || !push(d, curvature)) return false;
    // p + d >= 0 always; beyond, as far as the first p_i that comes to 0.
    const double nearest = maximum(s.n, [&](int i) {
      return p[at(i)] > 0 ? static_cast<double>(-d[at(i)]) / static_cast<double>(p[at(i)]) : 0.0;
    });
    step = slope / curvature;
    if (nearest > 0) step = std::min(step, std::max(1.0, 1 / nearest));
    const auto t = static_cast<Real>(step);
    for_each(s.n, [&](int i) {
      p[at(i)] = max(p[at(i)] + t * d[at(i)], Real(0));
      a.set(at(i), a[at(i)] + t * a_of_d[at(i)]);
    });
    length *= 2 * step;  // twice the best: rather more directions that reach a p_i of 0 than steps held short of it
    return true;
  }
};

}  // namespace

PressureResult improve_by_conjugate_directions(const IterationLimits& limits, const StepView& s, double dt,
                                               Array<Real>& pressure, PressureScratch& scratch) {
  PressureResult result;
  Conjugate solve{s, dt, pressure, scratch};
  solve.start();
  while (true) {
    solve.measure(result);
    ++result.iterations;
    result.converged = result.error <= limits.error && result.iterations >= limits.least;
    if (result.converged || result.iterations >= limits.most) break;
    if (!solve.improve()) {
      result.converged = result.error <= limits.error;
      break;
    }
  }
  for_each(s.n, [&](int i) { scratch.stress[at(i)] = pressure[at(i)] / (s.rho[i] * s.rho[i]); });
  return result;
}

}  // namespace sessile
