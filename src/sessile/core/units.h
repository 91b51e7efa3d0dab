#pragma once

namespace sessile {

/// The lengths and the density a scene is measured in.
struct Units {
  double spacing = 0;         ///< dx [m]
  double support_radius = 0;  ///< h [m]
  double rest_density = 0;    ///< rho0 [kg/m^3]

  double particle_mass() const { return rest_density * spacing * spacing * spacing; }  ///< rho0 dx^3 [kg]
};

}  // namespace sessile
