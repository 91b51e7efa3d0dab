#include "sessile/pressure/pcisph.h"

#include <algorithm>
#include <cmath>

#include "sessile/particles/density.h"
#include "sessile/pressure/density_rate.h"
#include "sessile/pressure/pressure_force.h"

namespace sessile {
namespace {

/// sum_j |grad W|^2 [1/m^2] of a particle inside a cubic lattice that `mass` (in rho0 dx^3) fills at rest density; of
/// one at dx for heavier ones, whose own lattice would leave few neighbours or none within h.
double lattice_gradients(const StepView& s, double mass) {
  const double spacing = s.units.spacing * std::min(1.0, std::cbrt(mass));
  const int reach = static_cast<int>(s.units.support_radius / spacing) + 1;
  double sum = 0;
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -reach; z <= reach; ++z) {
        const Separation<Real> pair(vec_cast<Real>(spacing * Vec3d{double(x), double(y), double(z)}));
        if (static_cast<double>(pair.r) >= s.units.support_radius) continue;
        sum += static_cast<double>(squared_length(s.W.gradient(pair)));
      }
    }
  }
  return sum;
}

}  // namespace

PressureResult solve(const Pcisph& method, const StepView& s, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch) {
  const double mass = maximum(s.n, [&](int i) { return static_cast<double>(s.m[i]); });
  const double gradients = lattice_gradients(s, mass);
  const auto delta = static_cast<Real>(1 / (2 * dt * dt * mass * mass * gradients));
  const auto step = static_cast<Real>(dt);

  PressureResult result;
  pressure.assign(s.n, 0);
  scratch.predicted_position.resize(s.n);
  StepView after = s;  // the liquid at its predicted positions
  while (true) {
    pressure_acceleration(s, pressure, scratch.stress, scratch.acceleration);
    for_each(s.n, [&](int i) {
      const auto k = static_cast<std::size_t>(i);
      const Vec3r v = predicted_velocity[k] + step * scratch.acceleration[k];
      scratch.predicted_position.set(k, s.x[i] + step * v);
    });
    after.x = s.paired(view(scratch.predicted_position));
    compute_density(after, scratch.advected);
    measure_error(
        s.n, [&](int i) { return max(scratch.advected[static_cast<std::size_t>(i)] - 1, Real(0)); }, result);
    ++result.iterations;
    result.converged = result.error <= method.error && result.iterations >= method.min_iterations;
    if (result.converged || result.iterations >= method.max_iterations) return result;
    for_each(s.n, [&](int i) {
      const auto k = static_cast<std::size_t>(i);
      pressure[k] = max(pressure[k] + delta * (scratch.advected[k] - 1), Real(0));
    });
  }
}

}  // namespace sessile
