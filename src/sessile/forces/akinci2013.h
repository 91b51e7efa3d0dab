#pragma once

#include <span>
#include <string_view>
#include <tuple>

#include "sessile/core/array.h"
#include "sessile/core/fields.h"

namespace sessile {

struct SolidForce;
struct StepView;
struct Units;
struct Walls;

/// Cohesion, surface area minimisation and adhesion of Akinci, Akinci and Teschner 2013, as published.
///   a_i = -gamma sum_j K_ij ( m_j C(r) x_ij/r + n_i - n_j ) - beta sum_b psi_b A(r) x_ib/r
///   K_ij = 2 rho0 / (rho_i + rho_j),  n_i = h sum_j (m_j/rho_j) grad W_ij
/// C is the paper's d(r) (18). One gamma stands before both terms, in m^4 kg^-1 s^-2 before the first and in m/s^2
/// before the second. The second is antisymmetric in m a for equal masses only: then the model conserves momentum.
struct Akinci2013 {
  double strength = 1;
  double adhesion = 5;

  static constexpr std::string_view name = "akinci2013";
  static constexpr std::string_view summary = "cohesion, area minimisation and adhesion of Akinci et al. 2013";
  static constexpr bool uses_normals = true;
  static constexpr auto fields() {
    using T = Akinci2013;
    return std::tuple{
        field(&T::strength, "tension", "m^4 kg^-1 s^-2 and m s^-2", non_negative,
              "gamma, strength of cohesion and of area minimisation"),
        field(&T::adhesion, "adhesion", "m^4 kg^-1 s^-2", non_negative,
              "beta, attraction to solids; each solid scales it by its own adhesion"),
    };
  }

  /// Adds this model's acceleration [m/s^2] of every particle.
  void add_acceleration(const StepView& view, Array3& acceleration) const;

  /// Adds to each solid the opposite of what its adhesion does to the liquid.
  void add_reaction(const StepView& view, const Walls& walls, std::span<SolidForce> forces) const;

  /// Macroscopic surface tension [N/m] of the cohesion term for a uniform pair distribution: (21/7040) gamma rho0^2
  /// h^2.
  double tension(const Units& units) const;
};

}  // namespace sessile
