#include "sessile/pressure/iisph.h"

#include "sessile/pressure/conjugate.h"
#include "sessile/pressure/jacobi.h"

namespace sessile {
namespace {

// Relaxed Jacobi steps (35), written with what the pressures at hand leave, and a part of the step before:
//   p^{l+1} = p^l + (omega/a_ii) ( rho0 - rho_adv - (A p^l)_i ) + momentum (p^l - p^{l-1}),  clamped to p >= 0
PressureResult relax(const Iisph& method, const IterationLimits& limits, const StepView& s, double dt,
                     Array<Real>& pressure, PressureScratch& scratch) {
  const auto share = static_cast<Real>(method.warm_start);
  for_each(s.n, [&](int i) { pressure[static_cast<std::size_t>(i)] *= share; });
  const auto relaxation = static_cast<Real>(method.relaxation);
  const auto momentum = static_cast<Real>(method.momentum);
  return iterate(
      limits, s, dt,
      [=](Real p, Real a_ii, Real predicted, Real before) {
        return max(p + relaxation / a_ii * (1 - predicted) + momentum * (p - before), Real(0));
      },
      pressure, scratch);
}

// The start is the mean of the pressures so far, not the last: a pressure that mends what one step did wrong would make
// the opposite fault in the next.
PressureResult conjugate(const Iisph& method, const IterationLimits& limits, const StepView& s, double dt,
                         Array<Real>& pressure, PressureScratch& scratch) {
  Array<Real>& mean = scratch.mean;
  if (mean.size() != s.n) mean = pressure;
  pressure = mean;
  const PressureResult result = improve_by_conjugate_directions(limits, s, dt, pressure, scratch);
  const auto renewal = static_cast<Real>(method.renewal);
  for_each(s.n, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    mean[k] += renewal * (pressure[k] - mean[k]);
  });
  return result;
}

}  // namespace

PressureResult solve(const Iisph& method, const StepView& s, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch) {
  pressure_coefficients(s, predicted_velocity, dt, scratch);
  if (method.prediction == Prediction::positions) advect_density_to_positions(s, predicted_velocity, dt, scratch);
  const IterationLimits limits{method.error, method.min_iterations, method.max_iterations};
  const auto& improve = method.iteration == Iteration::jacobi ? relax : conjugate;
  return improve(method, limits, s, dt, pressure, scratch);
}

}  // namespace sessile
