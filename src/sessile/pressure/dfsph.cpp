#include "sessile/pressure/dfsph.h"

#include "sessile/pressure/jacobi.h"

namespace sessile {
namespace {

/// Both solvers are the same iteration. In pressures, p = kappa rho and alpha = rho dt^2/(rho^2 |a_ii|), so
///   p_i += (rho*_i - rho0)/|a_ii|,  where it is positive
PressureResult correct(const IterationLimits& limits, double warm_start, const StepView& s, double dt,
                       Array<Real>& pressure, PressureScratch& scratch) {
  const auto share = static_cast<Real>(warm_start);
  for_each(s.n, [&](int i) { pressure[static_cast<std::size_t>(i)] *= share; });
  return iterate(
      limits, s, dt, [](Real p, Real a_ii, Real predicted, Real) { return p + max(predicted - 1, Real(0)) / -a_ii; },
      pressure, scratch);
}

}  // namespace

PressureResult solve(const Dfsph& method, const StepView& s, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch) {
  pressure_coefficients(s, predicted_velocity, dt, scratch);
  return correct({method.error, method.min_iterations, method.max_iterations}, method.warm_start, s, dt, pressure,
                 scratch);
}

PressureResult remove_divergence(const Dfsph& method, const StepView& s, Array3& velocity, double dt,
                                 Array<Real>& pressure, PressureScratch& scratch) {
  pressure_coefficients(s, velocity, dt, scratch);
  // The density that the velocities alone would bring to a particle at rest density.
  for_each(s.n, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    const bool few = s.near.count[i] + s.near_walls.count[i] < method.least_neighbors;
    scratch.advected[k] = few ? Real(0) : 1 + (scratch.advected[k] - s.rho[i]);
    if (few) pressure[k] = 0;
  });
  const PressureResult result = correct({method.divergence_error, 1, method.max_divergence_iterations},
                                        method.warm_start, s, dt, pressure, scratch);
  const auto step = static_cast<Real>(dt);
  for_each(s.n, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    velocity.set(k, velocity[k] + step * scratch.acceleration[k]);
  });
  return result;
}

}  // namespace sessile
