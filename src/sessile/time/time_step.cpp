#include "sessile/time/time_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace sessile {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// a/b, or infinity when there is nothing to bound.
double ratio(double a, double b) { return b > 0 ? a / b : infinite; }

struct Bound {
  std::string_view name;
  double dt;
};

Bound stability_bound(const TimeSettings& settings, const MotionScale& s) {
  const double dx = s.spacing;
  const std::array bounds{
      Bound{"cfl", settings.cfl * ratio(dx, s.speed)},
      Bound{"sound", s.sound_speed > 0 ? settings.cfl * ratio(dx, s.sound_speed + s.speed) : infinite},
      Bound{"force", settings.force_factor * std::sqrt(ratio(dx, s.acceleration))},
      Bound{"viscosity", settings.viscosity_factor * ratio(s.rest_density * dx * dx, s.viscosity)},
      Bound{"capillary", settings.capillary_factor *
                             std::sqrt(ratio(s.rest_density * dx * dx * dx, 2 * std::numbers::pi * s.tension))},
  };
  Bound least = bounds[0];
  for (const Bound& b : bounds) {
    if (b.dt < least.dt) least = b;
  }
  return least;
}

}  // namespace

TimeStep choose_time_step(const TimeSettings& settings, const MotionScale& scale, double last) {
  const Bound stable = stability_bound(settings, scale);
  if (settings.fixed_dt) {
    return {*settings.fixed_dt, "fixed", *settings.fixed_dt > stable.dt ? stable.name : ""};
  }
  Bound least = stable;
  if (settings.dt_max < least.dt) least = {"dt_max", settings.dt_max};
  if (last > 0 && last * settings.growth < least.dt) least = {"growth", last * settings.growth};
  // Iterations grow with the step: a solve that needs many of them is near the end of what its solver can do.
  if (scale.solver_effort > 1) {
    // Compression that is there already must go within one step, however short: below a tenth of the other bounds a
    // shorter one does not help.
    const double floor = 0.1 * std::min(stable.dt, settings.dt_max);
    const double shorter = std::max(floor, last * std::max(0.5, 1 / std::sqrt(scale.solver_effort)));
    if (shorter < least.dt) least = {"solver", shorter};
  }
  if (least.dt >= settings.dt_min) return {least.dt, least.name, ""};
  return {settings.dt_min, "dt_min", settings.dt_min > stable.dt ? stable.name : ""};
}

}  // namespace sessile
