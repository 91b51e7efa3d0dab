#pragma once

#include <array>
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

/// How (14) and (22) take x_ij: as printed, or divided by its length as in Akinci 2013.
enum class Direction { displacement, unit };

template <>
struct Words<Direction> {
  static constexpr std::array<std::string_view, 2> words{"displacement", "unit"};
};

/// The paper's surface features: cohesion, area minimisation and adhesion (eqs. 14, 18-23).
///   a_i = sum_j K_ij ( -alpha m_j d(r) e_ij - beta (n_i - n_j) ) - eta sum_b psi_b y(r_ib) e_ib
///   K_ij = 2 rho0^2 / (rho_i^2 + rho_j^2),  e_ij = x_ij (displacement) or x_ij / r (unit)
struct SurfaceFeature {
  double cohesion = 7.4;
  double area_minimisation = 1;
  double adhesion = 500;
  Direction direction = Direction::displacement;

  static constexpr std::string_view name = "surface_feature";
  static constexpr std::string_view summary = "the paper's cohesion, area minimisation and adhesion (eqs. 14, 18-23)";
  static constexpr bool uses_normals = true;
  static constexpr auto fields() {
    using T = SurfaceFeature;
    return std::tuple{
        field(&T::cohesion, "cohesion", "m^3 kg^-1 s^-2 (unit: m^4 kg^-1 s^-2)", non_negative,
              "alpha, strength of the attraction between fluid particles"),
        field(&T::area_minimisation, "area_minimisation", "m s^-2", non_negative,
              "beta, strength of the term that flattens the surface"),
        field(&T::adhesion, "adhesion", "m^3 kg^-1 s^-2 (unit: m^4 kg^-1 s^-2)", non_negative,
              "eta, attraction to solids; each solid scales it by its own adhesion"),
        field(&T::direction, "direction", "how x_ij enters cohesion and adhesion: as printed, or as a unit vector"),
    };
  }

  /// Adds this model's acceleration [m/s^2] of every particle.
  void add_acceleration(const StepView& view, Array3& acceleration) const;

  /// Adds to each solid the opposite of what its adhesion does to the liquid.
  void add_reaction(const StepView& view, const Walls& walls, std::span<SolidForce> forces) const;

  /// Macroscopic surface tension [N/m] of the cohesion term for a uniform pair distribution:
  /// (271/135168) alpha rho0^2 h^3 (displacement), (21/7040) alpha rho0^2 h^2 (unit).
  double tension(const Units& units) const;
};

}  // namespace sessile
