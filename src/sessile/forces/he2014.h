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

/// Surface tension from the energy of the colour's gradient, and air pressure, of He et al. 2014.
///   a_i = (1/rho_i) sum_j V_j ( (kappa/4) (|grad c_i|^2 + |grad c_j|^2) + p_air ) grad W_ij
///       + (1/rho_i) sum_b V_b p_air grad W_ib,   V = m/rho of the liquid, psi/rho0 of boundary particles
///   c_i = sum_j V_j W_ij + sum_b V_b W_ib (own term included)
///   grad c_i = (1/c_i) ( sum_j V_j c_j grad W_ij + sum_b V_b c_i grad W_ib )
/// The air pushes where neighbours are missing. Boundary particles stand in for them, in c with the colour of the
/// particle that feels them; so liquid is neither pushed nor drawn where it touches a solid. They take no part in the
/// tension. The publication's two scales belong to the liquid's inner pressure, which the pressure solver computes
/// here. Antisymmetric in m a: conserves momentum.
struct He2014 {
  double strength = 283.5;
  double air_pressure = 0;

  static constexpr std::string_view name = "he2014";
  static constexpr std::string_view summary = "energy of the colour's gradient, and air pressure, of He et al. 2014";
  static constexpr bool uses_normals = false;
  static constexpr auto fields() {
    using T = He2014;
    return std::tuple{
        field(&T::strength, "tension", "N", non_negative, "kappa, energy of the colour's gradient"),
        field(&T::air_pressure, "air_pressure", "Pa", non_negative, "p_air, pressure of the air on the free surface"),
    };
  }

  /// Adds this model's acceleration [m/s^2] of every particle.
  void add_acceleration(const StepView& view, Array3& acceleration) const;

  /// Adds to each solid the opposite of what its boundary particles' air pressure does to the liquid.
  void add_reaction(const StepView& view, const Walls& walls, std::span<SolidForce> forces) const;

  /// Macroscopic surface tension [N/m] of the gradient energy at a flat surface of uniform liquid: 0.08416 kappa/h, the
  /// integral of the pair forces in the continuum, by quadrature to all digits given. Air pressure is left out: its
  /// pair force is the opposite of that of a uniform inner pressure p_air/2.
  double tension(const Units& units) const;
};

}  // namespace sessile
