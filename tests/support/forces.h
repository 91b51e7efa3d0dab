#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <variant>
#include <vector>

#include "sessile/forces/force.h"
#include "support/cloud.h"

namespace sessile::test {

// 1e-6 in float, 1e-12 in double.
inline constexpr double antisymmetry = sizeof(Real) == 4 ? 1e-6 : 1e-12;
inline constexpr double rounding = sizeof(Real) == 4 ? 2e-6 : 1e-13;

/// What a force adds to a cloud at rest.
template <class Model>
Array3 acceleration(const Cloud& cloud, const Model& model, bool one_lane = false) {
  Array3 a;
  a.assign(cloud.particles.size(), {});
  model.add_acceleration(cloud.view(one_lane), a);
  return a;
}

inline Cloud pair_of_particles(double r) {
  Cloud cloud;
  cloud.add({0, 0, 0});
  cloud.add({r, 0, 0});
  cloud.look_around();
  return cloud;
}

/// A particle at height r above a boundary particle.
inline Cloud particle_above_wall(double r) {
  Cloud cloud;
  cloud.add({0, 0, r});
  cloud.add_wall({0, 0, 0});
  cloud.look_around();
  return cloud;
}

/// The points of a cubic lattice, at half spacings, that lie in a ball of radius R [spacings] about the origin.
inline Cloud ball(double R, Units units = {0.1, 0.2, 1000}) {
  Cloud cloud;
  cloud.units = units;
  const int n = static_cast<int>(R) + 1;
  for (int z = -n; z < n; ++z) {
    for (int y = -n; y < n; ++y) {
      for (int x = -n; x < n; ++x) {
        const Vec3d place{x + 0.5, y + 0.5, z + 0.5};
        if (length(place) < R) cloud.add(units.spacing * place);
      }
    }
  }
  cloud.look_around();
  return cloud;
}

/// What `model`, which must have no force but that of boundary particles, does to the liquid, it does to the solid with
/// the opposite sign.
template <class Model>
void expect_opposite_reaction(const Cloud& cloud, const Model& model) {
  const Array3 a = acceleration(cloud, model);
  SolidForce on_liquid;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3d f = cloud.units.particle_mass() * static_cast<double>(cloud.particles.mass[i]) * vec_cast<double>(a[i]);
    on_liquid.force += f;
    on_liquid.torque += cross(vec_cast<double>(cloud.particles.position[i]), f);
  }
  std::vector<SolidForce> on_solid(1);
  model.add_reaction(cloud.view(), cloud.walls, on_solid);
  const double pull = length(on_liquid.force);
  EXPECT_GT(pull, 0);
  EXPECT_LT(length(on_liquid.force + on_solid[0].force), antisymmetry * pull);
  EXPECT_LT(length(on_liquid.torque + on_solid[0].torque), antisymmetry * pull);
}

/// Tension [N/m] of a model of pair forces, from its forces alone: in a plate of finite width and height and endless
/// depth, the mean pull along the surface less that across it. Two widths, so that corners drop out; what acts in the
/// bulk is the same in all directions and drops out too. `uniform` makes all densities rho0 and takes the normals away.
///   sigma = - [ sum_i m_i (x a_x - z a_z) ](2w) + [ the same ](w),  over the 2 w depth of new surface
template <class Model>
double plate_tension(const Model& model, double support, bool uniform = false) {
  const double dx = 0.1;
  const int side = static_cast<int>(std::ceil(3 * support));
  const auto virial = [&](int width) {
    Cloud cloud;
    cloud.units = {dx, support * dx, 1000};
    cloud.space.periodic = true;
    cloud.space.period.y = static_cast<Real>(side * dx);
    cloud.space.inverse_period.y = static_cast<Real>(1 / (side * dx));
    for (int z = 0; z < side; ++z) {
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < width; ++x) cloud.add({dx * (x - width / 2), dx * y, dx * (z - side / 2)});
      }
    }
    cloud.look_around();
    if (uniform) cloud.density.assign(cloud.particles.size(), 1), cloud.normal.assign(cloud.particles.size(), {});
    const Array3 a = acceleration(cloud, model);
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Vec3d place = vec_cast<double>(cloud.particles.position[i]), pull = vec_cast<double>(a[i]);
      sum += cloud.units.particle_mass() * (place.x * pull.x - place.z * pull.z);
    }
    return sum;
  };
  const double new_surface = 2 * side * dx * side * dx;
  return (virial(side) - virial(2 * side)) / new_surface;
}

}  // namespace sessile::test
