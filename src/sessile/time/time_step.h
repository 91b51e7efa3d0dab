#pragma once

#include <array>
#include <string_view>

#include "sessile/scene/scene.h"

namespace sessile {

/// What the time step depends on at one moment, in SI units.
struct MotionScale {
  double spacing = 0;
  double rest_density = 0;
  double speed = 0;          ///< greatest |v| [m/s]
  double acceleration = 0;   ///< greatest |a| without pressure [m/s^2]
  double viscosity = 0;      ///< greatest mu, walls included [Pa s]
  double sound_speed = 0;    ///< at which pressure travels; 0 where it acts at once [m/s]
  double solver_effort = 0;  ///< of the last pressure solve; above 1 it asks for a shorter step
  double tension = 0;        ///< macroscopic sigma of all forces [N/m]
};

/// All that can set a time step; "" before the first one.
inline constexpr auto time_step_bounds = std::to_array<std::string_view>(
    {"", "cfl", "sound", "force", "viscosity", "capillary", "solver", "growth", "dt_max", "dt_min", "fixed"});

/// A time step and what set it.
struct TimeStep {
  double dt = 0;               ///< [s]
  std::string_view bound;      ///< one of time_step_bounds
  std::string_view overruled;  ///< the stability bound that dt_min or a fixed dt exceeds, or ""
};

/// The largest step that every bound allows (docs/model.md):
///   cfl dx/|v|max,  sound: cfl dx/(c_s + |v|max),  force sqrt(dx/|a|max),  viscosity rho0 dx^2/mu,  capillary
///   sqrt(rho0 dx^3/(2 pi sigma)),
/// kept in [dt_min, dt_max] and growing at most by `growth` over `last` (0: no step yet). A solve that took more than
/// its share of effort makes the next step shorter than the last ("solver").
TimeStep choose_time_step(const TimeSettings& settings, const MotionScale& scale, double last);

}  // namespace sessile
