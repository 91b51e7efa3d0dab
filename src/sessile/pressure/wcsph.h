#pragma once

#include <optional>
#include <string_view>
#include <tuple>

#include "sessile/core/fields.h"

namespace sessile {

/// Weakly compressible SPH: pressure by Tait's equation of state from the density at hand (Monaghan 1994; Becker and
/// Teschner 2007; the paper, after eq. 6).
///   p = rho0 c_s^2 / gamma ((rho/rho0)^gamma - 1),  at least 0
/// Compression stays near (v/c_s)^2 for speeds v. Sound crosses dx in no less than 1/cfl steps.
struct Wcsph {
  std::optional<double> sound_speed;
  double gamma = 7;

  static constexpr std::string_view name = "wcsph";
  static constexpr std::string_view summary = "weakly compressible SPH, Tait's equation of state";
  static constexpr bool frees_velocities_of_divergence = false;
  static constexpr auto fields() {
    using T = Wcsph;
    return std::tuple{
        derived(
            field(&T::sound_speed, "sound_speed", "m/s", positive, "c_s, speed of sound; dt <= cfl dx/(c_s + |v|max)"),
            "10 sqrt(v^2 + 2 g H + 16 sigma/(rho0 h)) of the start"),
        field(&T::gamma, "gamma", "", at_least(1), "exponent of the equation of state"),
    };
  }
};

}  // namespace sessile
