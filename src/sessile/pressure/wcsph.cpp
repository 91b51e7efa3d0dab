#include "sessile/pressure/wcsph.h"

#include <cmath>

#include "sessile/pressure/density_rate.h"
#include "sessile/pressure/pressure_force.h"

namespace sessile {

// The error reported is the compression that the pressure answers to, that of x(t): nothing is predicted.
PressureResult solve(const Wcsph& method, const StepView& s, const Array3&, double, Array<Real>& pressure,
                     PressureScratch& scratch) {
  const auto gamma = static_cast<Real>(method.gamma);
  const auto stiffness = static_cast<Real>(*method.sound_speed * *method.sound_speed / method.gamma);
  for_each(s.n, [&](int i) {
    pressure[static_cast<std::size_t>(i)] = max(stiffness * (std::pow(s.rho[i], gamma) - 1), Real(0));
  });
  pressure_acceleration(s, pressure, scratch.stress, scratch.acceleration);
  PressureResult result{1, true, 0, 0};
  measure_error(
      s.n, [&](int i) { return max(s.rho[i] - 1, Real(0)); }, result);
  return result;
}

}  // namespace sessile
