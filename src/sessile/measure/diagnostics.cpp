#include "sessile/measure/diagnostics.h"

#include <algorithm>
#include <cmath>

#include "sessile/core/parallel.h"
#include "sessile/simulation.h"

namespace sessile {

Motion motion(const Array3& position, const Array3& velocity, const Array<Real>& mass, double mass_unit,
              const Vec3d& gravity) {
  struct Sum {
    double mass_speed2 = 0, max_speed2 = 0;
    Vec3d momentum{}, moment{};
  };
  const auto of = [&](int particle) {
    const auto i = static_cast<std::size_t>(particle);
    const double m = mass[i];
    const auto v = vec_cast<double>(velocity[i]);
    return Sum{m * squared_length(v), squared_length(v), m * v, m * vec_cast<double>(position[i])};
  };
  const Sum sum = reduce(mass.size(), Sum{}, of, [](const Sum& a, const Sum& b) {
    return Sum{a.mass_speed2 + b.mass_speed2, std::max(a.max_speed2, b.max_speed2), a.momentum + b.momentum,
               a.moment + b.moment};
  });
  return {.kinetic_energy = 0.5 * mass_unit * sum.mass_speed2,
          .potential_energy = -mass_unit * dot(gravity, sum.moment),
          .momentum = mass_unit * sum.momentum,
          .max_speed = std::sqrt(sum.max_speed2)};
}

Extent extent(const Array3& position, const Array<Real>& mass) {
  struct Moment {
    double mass = 0;
    Vec3d moment{};
  };
  const auto moment_of = [&](int particle) {
    const auto i = static_cast<std::size_t>(particle);
    const double m = mass[i];
    return Moment{m, m * vec_cast<double>(position[i])};
  };
  const Moment total = reduce(mass.size(), Moment{}, moment_of, [](const Moment& a, const Moment& b) {
    return Moment{a.mass + b.mass, a.moment + b.moment};
  });
  if (!(total.mass > 0)) return {};

  struct Spread {
    double mass_distance2 = 0, farthest2 = 0;
  };
  const Vec3d centre = (1 / total.mass) * total.moment;
  const auto spread_of = [&](int particle) {
    const auto i = static_cast<std::size_t>(particle);
    const double distance2 = squared_length(vec_cast<double>(position[i]) - centre);
    return Spread{mass[i] * distance2, distance2};
  };
  const Spread spread = reduce(mass.size(), Spread{}, spread_of, [](const Spread& a, const Spread& b) {
    return Spread{a.mass_distance2 + b.mass_distance2, std::max(a.farthest2, b.farthest2)};
  });
  return {centre, std::sqrt(spread.mass_distance2 / total.mass), std::sqrt(spread.farthest2)};
}

Compression compression(const Array<Real>& density) {
  const auto excess = [&](int i) {
    return std::max(0.0, static_cast<double>(density[static_cast<std::size_t>(i)]) - 1);
  };
  const auto n = static_cast<double>(std::max<std::size_t>(1, density.size()));
  return {sum(density.size(), excess) / n, maximum(density.size(), excess)};
}

Diagnostics measure(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const Particles& particles = simulation.particles();
  const Units& units = simulation.units();
  return {
      .particles = static_cast<std::int64_t>(particles.size()),
      .motion = motion(particles.position, particles.velocity, particles.mass, units.particle_mass(), scene.gravity),
      .extent = extent(particles.position, particles.mass),
      .compression = compression(simulation.density()),
      .structure = structure({.position = particles.position,
                              .wall_position = simulation.walls().position,
                              .fluid_neighbors = simulation.fluid_neighbors(),
                              .wall_neighbors = simulation.wall_neighbors(),
                              .space = simulation.space(),
                              .spacing = units.spacing,
                              .support_radius = units.support_radius}),
      .out = simulation.totals().out,
      .lost = simulation.totals().lost};
}

}  // namespace sessile
