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

/// Continuum surface force of Brackbill et al. 1992 in the particle form of Mueller et al. 2003 (the paper's
/// (11)-(13)).
///   a_i = (sigma/rho_i) kappa_i n_i = -(sigma/rho_i) (lap c)_i n_i/|n_i|   where h |n_i| > threshold, else 0
///   c_i = sum_j (m_j/rho_j) W_ij (own term included),  n_i = grad c (inward),  kappa_i = -lap c/|n_i|
/// c is the liquid's alone, so that a wetted solid counts as a surface. Not antisymmetric: does not conserve momentum.
/// Particles sample one side of the surface only, where lap c is negative on a plane too: on a lattice's face the
/// inward acceleration is 8 sigma/(rho0 h^2) whatever the curvature (tests/unit/csf_test.cpp).
/// The default threshold stands between the first layer of lattice balls and planes (0.6 to 1.6) and the second (0.3).
struct Csf {
  double strength = 119.3;
  double threshold = 0.5;

  static constexpr std::string_view name = "csf";
  static constexpr std::string_view summary =
      "continuum surface force (Mueller et al. 2003 after Brackbill et al. 1992)";
  static constexpr bool uses_normals = true;
  static constexpr auto fields() {
    using T = Csf;
    return std::tuple{
        field(&T::strength, "tension", "N/m", non_negative, "sigma, the surface tension"),
        field(&T::threshold, "threshold", "", non_negative, "least h |grad c| of a particle at the surface"),
    };
  }

  /// Adds this model's acceleration [m/s^2] of every particle.
  void add_acceleration(const StepView& view, Array3& acceleration) const;

  /// Nothing: the model has no force between liquid and solids.
  void add_reaction(const StepView&, const Walls&, std::span<SolidForce>) const {}

  /// Macroscopic surface tension [N/m]: sigma itself.
  double tension(const Units& units) const;
};

}  // namespace sessile
