#pragma once

#include <cstdint>

#include "sessile/core/array.h"
#include "sessile/measure/structure.h"

namespace sessile {

class Simulation;

/// How the liquid moves.
struct Motion {
  double kinetic_energy = 0;    ///< [J]
  double potential_energy = 0;  ///< -sum m g.x [J], zero at the origin
  Vec3d momentum{};             ///< [kg m/s]
  double max_speed = 0;         ///< [m/s]
};

/// How far the liquid reaches. Positions are taken as they are, not as periodic images.
struct Extent {
  Vec3d centre{};                 ///< centre of mass [m]
  double radius_of_gyration = 0;  ///< sqrt(sum m |x - centre|^2 / sum m) [m]
  double farthest = 0;            ///< greatest distance of a particle from the centre of mass [m]
};

/// How much the liquid is compressed, over rest density. Deficits at the surface do not count.
struct Compression {
  double average = 0;  ///< (1/N) sum max(0, rho - rho0) / rho0
  double max = 0;      ///< max(0, rho - rho0) / rho0
};

/// All that is measured of one moment. The real density error is `compression`; a solver's prediction is StepReport's.
struct Diagnostics {
  std::int64_t particles = 0;
  Motion motion{};
  Extent extent{};
  Compression compression{};
  Structure structure{};
  std::int64_t out = 0;   ///< particles that left an open domain, since the start
  std::int64_t lost = 0;  ///< passages through a solid, since the start
};

/// Energies, momentum and greatest speed. `mass` is in units of `mass_unit` [kg]; gravity in m/s^2.
Motion motion(const Array3& position, const Array3& velocity, const Array<Real>& mass, double mass_unit,
              const Vec3d& gravity);

/// Centre of mass, radius of gyration and greatest distance [m]; zero without particles.
Extent extent(const Array3& position, const Array<Real>& mass);

/// Average and greatest compression of densities given over rest density; zero without particles.
Compression compression(const Array<Real>& density);

/// Measures the simulation as it stands. The same bits for any number of threads.
Diagnostics measure(const Simulation& simulation);

}  // namespace sessile
