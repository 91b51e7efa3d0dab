#pragma once

#include <string_view>
#include <tuple>

#include "sessile/core/fields.h"

namespace sessile {

/// Predictive-corrective incompressible SPH (Solenthaler and Pajarola 2009): pressures grow by the compression at
/// predicted positions, with one factor for all particles.
///   p_i += delta (rho*_i - rho0),  delta = rho0^2 / (2 dt^2 m^2 sum_j |grad W_ij|^2) of a particle inside a lattice
/// Neighbours at the predicted positions are those of x(t).
struct Pcisph {
  double error = 1e-4;
  int min_iterations = 3;
  int max_iterations = 100;
  int long_solve = 10;

  static constexpr std::string_view name = "pcisph";
  static constexpr std::string_view summary =
      "predictive-corrective incompressible SPH (Solenthaler and Pajarola 2009)";
  static constexpr bool frees_velocities_of_divergence = false;
  static constexpr auto fields() {
    using T = Pcisph;
    return std::tuple{
        field(&T::error, "error", "", positive, "average compression over rest density at which a solve ends"),
        field(&T::min_iterations, "min_iterations", "", at_least(1), "fewest iterations of a solve"),
        field(&T::max_iterations, "max_iterations", "", at_least(1),
              "most iterations of a solve; a solve that ends here is counted and reported"),
        field(&T::long_solve, "long_solve", "", at_least(1),
              "iterations above which a solve makes the next step shorter"),
    };
  }
};

}  // namespace sessile
