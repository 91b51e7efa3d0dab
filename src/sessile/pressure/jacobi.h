#pragma once

#include "sessile/pressure/density_rate.h"
#include "sessile/pressure/pressure_force.h"

namespace sessile {

/// When an iteration ends.
struct IterationLimits {
  double error;
  int least, most;
};

/// Improves the pressures p of the linear problem (29), (30), whose advected density and diagonal a_ii `scratch` holds,
/// until the compression they leave is small enough. `improved(p_i, a_ii, predicted_i, before_i)` gives the next p_i
/// from the density predicted with this one; before_i is the one before it (at first p_i). Each turn measures what the
/// pressures at hand leave, and improves them: the loop ends with pressures whose own error was measured, and with
/// their acceleration. Internal.
template <class Improve>
PressureResult iterate(const IterationLimits& limits, const StepView& s, double dt, const Improve& improved,
                       Array<Real>& pressure, PressureScratch& scratch) {
  PressureResult result;
  scratch.next.resize(s.n);
  while (true) {
    pressure_acceleration(s, pressure, scratch.stress, scratch.acceleration);
    density_change(s, scratch.acceleration, dt, scratch.change);
    measure_error(
        s.n,
        [&](int i) {
          const auto k = static_cast<std::size_t>(i);
          const Real predicted = scratch.advected[k] + scratch.change[k];
          const Real before = result.iterations == 0 ? pressure[k] : scratch.next[k];
          scratch.next[k] =
              scratch.diagonal[k] < 0 ? improved(pressure[k], scratch.diagonal[k], predicted, before) : Real(0);
          return max(predicted - 1, Real(0));
        },
        result);
    ++result.iterations;
    result.converged = result.error <= limits.error && result.iterations >= limits.least;
    if (result.converged || result.iterations >= limits.most) return result;
    pressure.swap(scratch.next);  // what was at hand stays there for the next turn
  }
}

}  // namespace sessile
