#include <gtest/gtest.h>

#include "sessile/pressure/solve.h"
#include "support/cloud.h"
#include "support/scenes.h"

namespace sessile::dfsph_test {
namespace {

constexpr double dt = 0.002;
constexpr double rounding = sizeof(Real) == 4 ? 2e-4 : 1e-11;

class DivergenceSolve : public testing::Test {
 protected:
  void run(bool one_lane = false) {
    pressure.assign(cloud.particles.size(), 0);
    velocity = cloud.particles.velocity;
    result = remove_divergence(method, cloud.view(one_lane), velocity, dt, pressure, scratch);
  }
  test::Cloud cloud = test::falling_block(1);
  Dfsph method{.divergence_error = 1e-5};
  Array<Real> pressure;
  Array3 velocity;
  PressureScratch scratch;
  PressureResult result;
};

TEST_F(DivergenceSolve, LeavesVelocitiesThatDoNotCompress) {
  run();
  EXPECT_TRUE(result.converged);
  const auto compression = [&](const Array3& v) {  // average of what a step would bring
    PressureScratch of;
    pressure_coefficients(cloud.view(), v, dt, of);
    double sum = 0;
    for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
      if (cloud.near.count(i) + cloud.near_walls.count(i) < method.least_neighbors) continue;
      sum += std::max(0.0, static_cast<double>(of.advected[i] - cloud.density[i]));
    }
    return sum / static_cast<double>(cloud.particles.size());
  };
  EXPECT_GT(compression(cloud.particles.velocity), 20 * method.divergence_error);
  EXPECT_LT(compression(velocity), 1.1 * method.divergence_error);
  EXPECT_NEAR(compression(velocity), result.error, 0.1 * method.divergence_error);
}

TEST_F(DivergenceSolve, LanesAgreeWithOneLane) {
  run();
  const Array3 lanes = velocity;
  run(true);
  EXPECT_LT(test::difference(lanes, velocity), rounding);
}

TEST_F(DivergenceSolve, LetsLiquidFlyApart) {
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
    cloud.particles.velocity.set(i, cloud.particles.position[i] + Vec3r{0, 0, Real(0.2)});
  }
  run();
  EXPECT_EQ(result.iterations, 1);
  EXPECT_EQ(test::difference(velocity, cloud.particles.velocity), 0);
}

TEST_F(DivergenceSolve, LetsParticlesWithFewNeighboursBe) {
  cloud = {};
  cloud.add({0, 0, 0}, {1, 0, 0});
  cloud.add({0.12, 0, 0}, {-1, 0, 0});
  cloud.look_around();
  run();
  EXPECT_EQ(velocity[0], (Vec3r{1, 0, 0}));
  method.least_neighbors = 0;
  run();
  EXPECT_LT(velocity[0].x, Real(0.1)) << "else they are stopped";
}

TEST_F(DivergenceSolve, ConservesMomentumAwayFromWalls) {
  cloud = test::lattice(9, 0.2);
  cloud.look_around();
  run();
  Array3 gained = velocity;
  for (std::size_t i = 0; i < gained.size(); ++i) gained.set(i, velocity[i] - cloud.particles.velocity[i]);
  EXPECT_LT(test::net_over_total(cloud, gained), sizeof(Real) == 4 ? 1e-5 : 1e-12);
}

TEST(Dfsph, StepsEndWithVelocitiesFreeOfDivergenceAndTheWallFeelsIt) {
  Scene scene = test::column(8, 8);
  scene.gravity = {};
  scene.bodies[0].velocity = {0, 0, -1};
  scene.pressure = Dfsph{};
  Simulation simulation(scene);
  const double mass = simulation.units().particle_mass() * 512;
  double impulse = 0;
  for (int k = 0; k < 30; ++k) {
    simulation.step();
    impulse += simulation.last_step().dt * simulation.walls().forces[0].force.z;
  }
  EXPECT_GT(simulation.totals().divergence_iterations, 29);
  double momentum = 0;
  for (const Real vz : simulation.particles().velocity.z) momentum += mass / 512 * static_cast<double>(vz);
  EXPECT_NEAR(impulse / -(momentum + mass), 1, 1e-3) << "both solvers push the floor with what they take";
}

}  // namespace
}  // namespace sessile::dfsph_test
