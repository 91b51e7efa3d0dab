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

/// Pair force of Tartakovsky and Meakin 2005: repels below h/3, attracts beyond.
///   a_i = (1/m_i) ( sum_j s cos(3 pi r/(2h)) x_ij/r + sum_b s_w (psi_b/(rho0 dx^3)) cos(3 pi r/(2h)) x_ib/r ),  r < h
/// A boundary particle counts by its volume over dx^3. Antisymmetric in m a: conserves momentum.
struct Tartakovsky2005 {
  double strength = 8.8;
  double adhesion = 8.8;

  static constexpr std::string_view name = "tartakovsky2005";
  static constexpr std::string_view summary =
      "pair force that repels close by and attracts beyond (Tartakovsky and Meakin 2005)";
  static constexpr bool uses_normals = false;
  static constexpr auto fields() {
    using T = Tartakovsky2005;
    return std::tuple{
        field(&T::strength, "tension", "N", non_negative, "s, strength of the force between fluid particles"),
        field(&T::adhesion, "adhesion", "N", non_negative,
              "s_w, strength of the force of solids; each solid scales it by its own adhesion"),
    };
  }

  /// Adds this model's acceleration [m/s^2] of every particle.
  void add_acceleration(const StepView& view, Array3& acceleration) const;

  /// Adds to each solid the opposite of what its force does to the liquid.
  void add_reaction(const StepView& view, const Walls& walls, std::span<SolidForce> forces) const;

  /// Macroscopic surface tension [N/m] for a uniform pair distribution:
  ///   (pi/8) n^2 int_0^h -s cos(3 pi r/(2h)) r^4 dr = (pi/8) (s/dx) (h/dx)^5 (1/k - 12/k^3 + 24/k^5),  k = 3 pi/2
  double tension(const Units& units) const;
};

}  // namespace sessile
