#include "sessile/measure/diagnostics.h"

#include <algorithm>
#include <cmath>

#include "sessile/measure/blocks.h"
#include "sessile/simulation.h"

namespace sessile {

Motion motion(const Array3& position, const Array3& velocity, const Array<Real>& mass, double mass_unit,
              const Vec3d& gravity) {
  struct Part {
    double mass_speed2 = 0, max_speed2 = 0;
    Vec3d momentum{}, moment{};
  };
  const auto parts = measure_blocks<Part>(mass.size(), [&](std::size_t begin, std::size_t end, Part& part) {
    for (std::size_t i = begin; i < end; ++i) {
      const double m = mass[i];
      const auto v = vec_cast<double>(velocity[i]);
      const double speed2 = squared_length(v);
      part.mass_speed2 += m * speed2;
      part.max_speed2 = std::max(part.max_speed2, speed2);
      part.momentum += m * v;
      part.moment += m * vec_cast<double>(position[i]);
    }
  });
  Part sum;
  for (const Part& part : parts) {
    sum.mass_speed2 += part.mass_speed2;
    sum.max_speed2 = std::max(sum.max_speed2, part.max_speed2);
    sum.momentum += part.momentum;
    sum.moment += part.moment;
  }
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
  const std::size_t n = mass.size();
  const auto moments = measure_blocks<Moment>(n, [&](std::size_t begin, std::size_t end, Moment& part) {
    for (std::size_t i = begin; i < end; ++i) {
      const double m = mass[i];
      part.mass += m;
      part.moment += m * vec_cast<double>(position[i]);
    }
  });
  Moment sum;
  for (const Moment& part : moments) {
    sum.mass += part.mass;
    sum.moment += part.moment;
  }
  if (!(sum.mass > 0)) return {};

  struct Spread {
    double mass_distance2 = 0, farthest2 = 0;
  };
  const Vec3d centre = (1 / sum.mass) * sum.moment;
  const auto spreads = measure_blocks<Spread>(n, [&](std::size_t begin, std::size_t end, Spread& part) {
    for (std::size_t i = begin; i < end; ++i) {
      const double distance2 = squared_length(vec_cast<double>(position[i]) - centre);
      part.mass_distance2 += mass[i] * distance2;
      part.farthest2 = std::max(part.farthest2, distance2);
    }
  });
  Spread spread;
  for (const Spread& part : spreads) {
    spread.mass_distance2 += part.mass_distance2;
    spread.farthest2 = std::max(spread.farthest2, part.farthest2);
  }
  return {centre, std::sqrt(spread.mass_distance2 / sum.mass), std::sqrt(spread.farthest2)};
}

Compression compression(const Array<Real>& density) {
  const auto parts =
      measure_blocks<Compression>(density.size(), [&](std::size_t begin, std::size_t end, Compression& part) {
        for (std::size_t i = begin; i < end; ++i) {
          const double excess = std::max(0.0, static_cast<double>(density[i]) - 1);
          part.average += excess;
          part.max = std::max(part.max, excess);
        }
      });
  Compression result;
  for (const Compression& part : parts) {
    result.average += part.average;
    result.max = std::max(result.max, part.max);
  }
  if (!density.empty()) result.average /= static_cast<double>(density.size());
  return result;
}

Diagnostics measure(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const Particles& particles = simulation.particles();
  const double mass_unit = scene.fluid.rest_density * std::pow(scene.spacing, 3);
  return {.particles = static_cast<std::int64_t>(particles.size()),
          .motion = motion(particles.position, particles.velocity, particles.mass, mass_unit, scene.gravity),
          .extent = extent(particles.position, particles.mass),
          .compression = compression(simulation.density()),
          .structure = structure({.position = particles.position,
                                  .wall_position = simulation.walls().position,
                                  .fluid_neighbors = simulation.fluid_neighbors(),
                                  .wall_neighbors = simulation.wall_neighbors(),
                                  .space = simulation.space(),
                                  .spacing = scene.spacing,
                                  .support_radius = scene.support_radius()}),
          .out = simulation.totals().out,
          .lost = simulation.totals().lost};
}

}  // namespace sessile
