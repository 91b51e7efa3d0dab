#pragma once

#include <string_view>
#include <tuple>

#include "sessile/core/fields.h"

namespace sessile {

/// Divergence-free SPH (Bender and Koschier 2017): one solver keeps the density, another keeps the velocities that a
/// step starts from free of divergence. With D rho/Dt = sum_j m_j (v_i - v_j) . grad W_ij,
///   density:     kappa_i   = (rho*_i - rho0)/dt^2 alpha_i,  where rho*_i > rho0
///   divergence:  kappa^v_i = (1/dt) D rho_i/Dt alpha_i,      where D rho_i/Dt > 0
///   v_i -= dt sum_j m_j (kappa_i/rho_i + kappa_j/rho_j) grad W_ij,  alpha_i = rho_i/(|g_i|^2 + sum_j |m_j grad
///   W_ij|^2)
/// kappa_i rho_i is a pressure, and the sums of it over a solve are what the next solve starts from.
struct Dfsph {
  double error = 1e-4;
  double divergence_error = 1e-3;
  int min_iterations = 2;
  int max_iterations = 200;
  int long_solve = 50;
  int max_divergence_iterations = 200;
  double warm_start = 0.25;
  int least_neighbors = 20;

  static constexpr std::string_view name = "dfsph";
  static constexpr std::string_view summary =
      "divergence-free SPH, density and divergence solver (Bender and Koschier 2017)";
  static constexpr bool frees_velocities_of_divergence = true;
  static constexpr auto fields() {
    using T = Dfsph;
    return std::tuple{
        field(&T::error, "error", "", positive,
              "average compression over rest density at which the density solve ends"),
        field(&T::divergence_error, "divergence_error", "", positive,
              "average compression a step would bring, over rest density, at which the divergence solve ends"),
        field(&T::min_iterations, "min_iterations", "", at_least(1), "fewest iterations of the density solve"),
        field(&T::max_iterations, "max_iterations", "", at_least(1),
              "most iterations of the density solve; a solve that ends here is counted and reported"),
        field(&T::max_divergence_iterations, "max_divergence_iterations", "", at_least(1),
              "most iterations of the divergence solve"),
        field(&T::warm_start, "warm_start", "", between(0, 1),
              "share of the last step's pressures the solves start from"),
        field(&T::least_neighbors, "least_neighbors", "", non_negative,
              "neighbours, boundary particles among them, below which the divergence of a particle is let be"),
        field(&T::long_solve, "long_solve", "", at_least(1),
              "iterations above which a solve makes the next step shorter"),
    };
  }
};

}  // namespace sessile
