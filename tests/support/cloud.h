#pragma once

#include <omp.h>

#include <random>
#include <vector>

#include "sessile/core/units.h"
#include "sessile/forces/viscosity.h"
#include "sessile/kernels/cubic_spline.h"
#include "sessile/neighbors/step_view.h"
#include "sessile/particles/density.h"

namespace sessile::test {

/// Particles and boundary particles without a scene: what the pair laws see, built from plain points.
struct Cloud {
  Units units{0.1, 0.2, 1000};
  Space space;
  Particles particles;
  Walls walls;
  Grid grid, wall_grid;
  NeighborList near, near_walls;
  Array<Real> density;
  Array<Real> position_pairs;
  mutable Array<Real> pairs;
  Array3 normal;

  void add(const Vec3d& x, const Vec3d& v = {}, double mass = 1) {
    particles.add(vec_cast<Real>(x), vec_cast<Real>(v), static_cast<Real>(mass),
                  static_cast<std::int64_t>(particles.size()));
  }
  /// A boundary particle with psi of a flat lattice.
  void add_wall(const Vec3d& x, std::int32_t solid = 0) {
    walls.position.push_back(vec_cast<Real>(x));
    walls.velocity.push_back({});
    walls.psi.push_back(Real(1.43));
    walls.adhesion.push_back(1);
    walls.viscosity.push_back(Real(0.02));
    walls.solid.push_back(solid);
  }

  /// Sorts, finds neighbours, computes density and normals. Boundary particles must have been added in grid order or be
  /// few.
  void look_around(bool one_lane = false) {
    const GridShape shape = GridShape::make(units.support_radius, {}, vec_cast<double>(space.period));
    const auto h = static_cast<Real>(units.support_radius);
    grid.build(particles.position, shape);
    particles.reorder(grid.order());
    wall_grid.build(walls.position, shape);
    const std::vector<std::int32_t> order(wall_grid.order().begin(), wall_grid.order().end());
    const auto sort = [&](auto& array) {
      auto old = array;
      for (std::size_t k = 0; k < order.size(); ++k) array[k] = old[static_cast<std::size_t>(order[k])];
    };
    sort(walls.position.x), sort(walls.position.y), sort(walls.position.z), sort(walls.psi), sort(walls.solid);
    near.build({particles.position, grid}, {particles.position, grid}, space, h);
    near_walls.build({particles.position, grid}, {walls.position, wall_grid}, space, h);
    pair_positions();
    compute_density(view(one_lane), density);
    compute_normals(view(one_lane), normal);
  }

  /// To be called when particles have moved without a look_around().
  void pair_positions() {
    position_pairs.resize(2 * particles.size());
    pairs.resize(2 * particles.size());
    pair_up(sessile::view(particles.position), particles.size(), position_pairs.data());
  }

  StepView view(bool one_lane = false) const {
    StepView s(units, space, particles, walls, near, near_walls);
    s.rho = sessile::view(density);
    s.normal = sessile::view(normal);
    s.x.xy = position_pairs.data();
    s.pairs = pairs.data();
    s.one_lane = one_lane;
    return s;
  }
};

/// A cubic lattice of n^3 particles at `units.spacing`, each shifted by at most `jitter` spacings per axis, with random
/// velocities up to 1 m/s; with `floor`, one layer of boundary particles a spacing below.
inline Cloud lattice(int n, double jitter, bool floor = false, unsigned seed = 1, Units units = {0.1, 0.2, 1000}) {
  Cloud cloud;
  cloud.units = units;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-jitter, jitter), speed(-1, 1);
  const double dx = units.spacing;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const Vec3d place{dx * (x + shift(random)), dx * (y + shift(random)), dx * (z + shift(random))};
        cloud.add(place, {speed(random), speed(random), speed(random)});
      }
    }
  }
  if (floor) {
    for (int y = -3; y < n + 3; ++y) {
      for (int x = -3; x < n + 3; ++x) cloud.add_wall({dx * x, dx * y, -dx});
    }
    cloud.walls.labels = {"floor"};
    cloud.walls.centres = {Vec3d{}};
    cloud.walls.forces.resize(1);
  }
  return cloud;
}

/// A block above a floor that moves on to it at `speed` [m/s].
inline Cloud falling_block(double speed, unsigned seed = 1) {
  Cloud cloud = lattice(8, 0.05, true, seed);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
    cloud.particles.velocity.set(i, {0, 0, static_cast<Real>(-speed)});
  }
  cloud.look_around();
  return cloud;
}

/// |sum_i m_i a_i| over sum_i m_i |a_i|.
inline double net_over_total(const Cloud& cloud, const Array3& a) {
  Vec3d net;
  double total = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3d f = static_cast<double>(cloud.particles.mass[i]) * vec_cast<double>(a[i]);
    net += f;
    total += length(f);
  }
  return length(net) / total;
}

/// Greatest difference of two fields over the greatest magnitude of the first.
inline double difference(const Array3& a, const Array3& b) {
  double greatest = 0, apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    greatest = std::max(greatest, static_cast<double>(length(a[i])));
    apart = std::max(apart, static_cast<double>(length(a[i] - b[i])));
  }
  return apart / greatest;
}

/// Runs f with a number of threads, and puts the old number back.
template <class F>
void with_threads(int threads, F&& f) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  f();
  omp_set_num_threads(before);
}

}  // namespace sessile::test
