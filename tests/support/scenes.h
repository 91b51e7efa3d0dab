#pragma once

#include <limits>

#include "sessile/simulation.h"

namespace sessile::test {

/// Gravity [m/s^2] that no velocity can hold after a step of a thousand seconds.
inline constexpr double beyond_all = 0.9 * static_cast<double>(std::numeric_limits<Real>::max());

/// A free block of n^3 particles at the paper's scale, without gravity, at a fixed step.
inline Scene block(int n, double dt = 2e-3, double end = 1) {
  Scene scene;
  scene.spacing = 0.1;
  scene.gravity = {};
  scene.time.end = end;
  scene.time.fixed_dt = dt;
  scene.fluid.viscosity = 20;
  Body body;
  body.label = "block";
  body.shape = Box{{0.1 * n, 0.1 * n, 0.1 * n}};
  scene.bodies = {body};
  return scene;
}

/// Distance over dx from a flat layer of boundary particles at which a cubic lattice has rest density. At one dx its
/// density is 6 % above, as a lone layer's psi is 1.43 rho0 dx^3: liquid set there would be thrown off in the first
/// step.
inline constexpr double rest_distance = 1.1;

/// A layer of liquid, periodic along x and y, above a floor at z = 0: `width` particles a side, `depth` layers.
inline Scene column(int width, int depth, double dt = 2e-3) {
  Scene scene;
  scene.spacing = 0.1;
  const double dx = scene.spacing, size = width * dx;
  scene.time.end = 5;
  scene.time.fixed_dt = dt;
  scene.fluid.viscosity = 20;
  scene.domain = Domain{
      {-size / 2, -size / 2, -1}, {size / 2, size / 2, depth * dx + 2}, Edge::periodic, Edge::periodic, Edge::open};
  Body body;
  body.shape = Box{{size, size, depth * dx}};
  body.placement.position = {0, 0, (rest_distance - 0.5 + 0.5 * depth) * dx};
  scene.bodies = {body};
  Solid floor;
  floor.label = "floor";
  floor.shape = Plate{size - dx, size - dx};  // its samples repeat with the period
  scene.solids = {floor};
  return scene;
}

inline void run(Simulation& simulation) {
  while (!simulation.finished()) simulation.step();
}

inline double kinetic_energy(const Simulation& simulation) {
  double energy = 0;
  const Particles& p = simulation.particles();
  for (std::size_t i = 0; i < p.size(); ++i) {
    energy += 0.5 * static_cast<double>(p.mass[i]) * squared_length(vec_cast<double>(p.velocity[i]));
  }
  return energy * simulation.units().particle_mass();
}

}  // namespace sessile::test
