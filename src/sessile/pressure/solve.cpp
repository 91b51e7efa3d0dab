#include "sessile/pressure/solve.h"

#include <type_traits>
#include <variant>

#include "sessile/neighbors/step_view.h"

namespace sessile {

PressureResult solve(const Pressure& method, const StepView& view, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch) {
  scratch.acceleration.resize(view.n);
  if (view.n == 0) return {0, true, 0, 0};
  return std::visit([&](const auto& chosen) { return solve(chosen, view, predicted_velocity, dt, pressure, scratch); },
                    method);
}

bool frees_velocities_of_divergence(const Pressure& method) {
  return std::visit([](const auto& chosen) { return chosen.frees_velocities_of_divergence; }, method);
}

PressureResult remove_divergence(const Pressure& method, const StepView& view, Array3& velocity, double dt,
                                 Array<Real>& pressure, PressureScratch& scratch) {
  return std::visit(
      [&](const auto& chosen) {
        if constexpr (std::remove_cvref_t<decltype(chosen)>::frees_velocities_of_divergence) {
          return remove_divergence(chosen, view, velocity, dt, pressure, scratch);
        } else {
          return PressureResult{0, true, 0, 0};
        }
      },
      method);
}

double sound_speed(const Pressure& method) {
  return std::visit(
      [](const auto& chosen) {
        if constexpr (requires { chosen.sound_speed; }) {
          return chosen.sound_speed.value_or(0);
        } else {
          return 0.0;
        }
      },
      method);
}

double effort(const Pressure& method, int iterations) {
  return std::visit(
      [&](const auto& chosen) {
        if constexpr (requires { chosen.long_solve; }) {
          return static_cast<double>(iterations) / chosen.long_solve;
        } else {
          return 0.0;
        }
      },
      method);
}

}  // namespace sessile
