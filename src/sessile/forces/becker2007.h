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

/// Attraction weighted by the kernel, of Becker and Teschner 2007.
///   a_i = -(kappa/m_i) sum_j m_j x_ij W( max(r, dx) )
/// Closer than one particle diameter dx the weight stays what it is at dx. The force is antisymmetric for equal masses
/// only: then the model conserves momentum.
struct Becker2007 {
  double strength = 4.13;

  static constexpr std::string_view name = "becker2007";
  static constexpr std::string_view summary = "attraction weighted by the kernel, of Becker and Teschner 2007";
  static constexpr bool uses_normals = false;
  static constexpr auto fields() {
    using T = Becker2007;
    return std::tuple{
        field(&T::strength, "tension", "m^3 s^-2", non_negative, "kappa, strength of the attraction"),
    };
  }

  /// Adds this model's acceleration [m/s^2] of every particle.
  void add_acceleration(const StepView& view, Array3& acceleration) const;

  /// Nothing: the model has no force between liquid and solids.
  void add_reaction(const StepView&, const Walls&, std::span<SolidForce>) const {}

  /// Macroscopic surface tension [N/m] for a uniform pair distribution; at h = 2 dx 0.02889 rho0 kappa.
  ///   (pi/8) n^2 int_0^h kappa m r^5 W dr = rho0 kappa (h/dx)^3 int_0^1 w q^5 dq,  n = 1/dx^3,  W = 8/(pi h^3) w(q)
  double tension(const Units& units) const;
};

}  // namespace sessile
