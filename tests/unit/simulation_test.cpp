#include "sessile/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sessile/core/error.h"
#include "support/cloud.h"
#include "support/scenes.h"

namespace sessile {
namespace {

std::string refusal(const Scene& scene) {
  try {
    const Simulation simulation(scene);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

Solid plate(double size, double z) {
  Solid solid;
  solid.label = "floor";
  solid.shape = Plate{size, size};
  solid.placement.position = {0, 0, z};
  return solid;
}

TEST(Simulation, FreeFallIsParabolic) {
  Scene scene = test::block(4);
  scene.gravity = {0, 0, -10};
  Simulation simulation(scene);
  const double before = static_cast<double>(simulation.particles().position.z[0]);
  const auto id = simulation.particles().id[0];
  for (int k = 0; k < 100; ++k) simulation.step();
  const Particles& p = simulation.particles();
  const auto place = std::find(p.id.begin(), p.id.end(), id) - p.id.begin();
  const double t = simulation.time(), dt = 2e-3;
  EXPECT_NEAR(t, 0.2, 1e-12);
  // Symplectic Euler falls half a step further than the parabola.
  EXPECT_NEAR(static_cast<double>(p.position.z[static_cast<std::size_t>(place)]) - before, -5 * t * t - 5 * t * dt,
              1e-4);
}

TEST(Simulation, GivesTheSameBitsForAnyNumberOfThreads) {
  const auto state = [](int threads) {
    Particles end;
    test::with_threads(threads, [&] {
      Scene scene = test::block(12, 4e-3);
      scene.gravity = {0, 0, -9.81};
      scene.bodies[0].placement.position = {0, 0, 0.66};
      scene.bodies[0].velocity = {0.3, 0.1, -3};
      scene.forces = {SurfaceFeature{}};
      scene.solids = {plate(4, 0)};
      Simulation simulation(scene);
      for (int k = 0; k < 40; ++k) simulation.step();
      end = simulation.particles();
    });
    return end;
  };
  const Particles one = state(1);
  for (const int threads : {2, 8}) {
    const Particles many = state(threads);
    EXPECT_EQ(one.id, many.id);
    EXPECT_EQ(one.position.x, many.position.x) << threads;
    EXPECT_EQ(one.position.y, many.position.y);
    EXPECT_EQ(one.position.z, many.position.z);
    EXPECT_EQ(one.velocity.x, many.velocity.x);
    EXPECT_EQ(one.pressure, many.pressure);
  }
}

TEST(Simulation, NeighboursAndDensitiesBelongToTheCurrentPositions) {
  Scene scene = test::block(6);
  scene.bodies[0].velocity = {1, 0, 0};
  Simulation simulation(scene);
  simulation.step();
  test::Cloud cloud;
  const Particles& p = simulation.particles();
  for (std::size_t i = 0; i < p.size(); ++i) cloud.add(vec_cast<double>(p.position[i]));
  cloud.look_around();
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(simulation.density()[i], cloud.density[i]);
}

TEST(Simulation, ClosedSystemKeepsItsMomentum) {
  Scene scene = test::block(8, 4e-3);
  scene.forces = {SurfaceFeature{}};
  scene.bodies[0].velocity = {0.5, -0.2, 0.1};
  Simulation simulation(scene);
  const double mass = 512;
  for (int k = 0; k < 100; ++k) simulation.step();
  Vec3d momentum;
  for (std::size_t i = 0; i < simulation.particles().size(); ++i) {
    momentum += vec_cast<double>(simulation.particles().velocity[i]);
  }
  EXPECT_NEAR(momentum.x / mass, 0.5, 1e-5);
  EXPECT_NEAR(momentum.y / mass, -0.2, 1e-5);
  EXPECT_NEAR(momentum.z / mass, 0.1, 1e-5);
}

TEST(Simulation, TakesOutAndCountsWhatLeavesAnOpenDomain) {
  Scene scene = test::block(4);
  scene.bodies[0].velocity = {10, 0, 0};
  scene.domain = Domain{{-1, -1, -1}, {1, 1, 1}};
  Simulation simulation(scene);
  for (int k = 0; k < 100; ++k) simulation.step();  // 2 m
  EXPECT_EQ(simulation.particles().size(), 0u);
  EXPECT_EQ(simulation.totals().out, 64);
  EXPECT_EQ(simulation.totals().lost, 0);
  simulation.step();  // and an empty domain goes on
}

TEST(Simulation, BringsBackWhatCrossesAPeriodicFace) {
  Scene scene = test::block(4);
  scene.bodies[0].velocity = {10, 0, 0};
  scene.domain = Domain{{-1, -1, -1}, {1, 1, 1}, Edge::periodic, Edge::open, Edge::open};
  Simulation simulation(scene);
  for (int k = 0; k < 50; ++k) simulation.step();  // half a period
  EXPECT_EQ(simulation.particles().size(), 64u);
  for (const Real x : simulation.particles().position.x) {
    EXPECT_GE(x, -1);
    EXPECT_LT(x, 1);
  }
  // Cut in two by the face, it is still one block: 10 m/s * 0.1 s = 1 m.
  for (std::size_t i = 0; i < 64; ++i) EXPECT_GE(simulation.fluid_neighbors().count(i), 7);
}

TEST(Simulation, ClosedDomainHoldsTheLiquid) {
  Scene scene = test::block(5, 4e-3);
  scene.gravity = {0, 0, -9.81};
  scene.domain = Domain{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, Edge::closed, Edge::closed, Edge::closed};
  Simulation simulation(scene);
  for (int k = 0; k < 300; ++k) simulation.step();
  EXPECT_EQ(simulation.particles().size(), 125u);
  EXPECT_EQ(simulation.totals().lost, 0);
  for (std::size_t i = 0; i < 125; ++i) {
    EXPECT_LT(std::abs(static_cast<double>(simulation.particles().position.z[i])), 0.5);
  }
}

TEST(Simulation, CountsWhatPassesThroughASolid) {
  Scene scene = test::block(2, 2e-2);
  scene.bodies[0].placement.position = {0, 0, 0.5};
  scene.bodies[0].velocity = {0, 0, -100};  // 2 m a step: no solver can stop that
  scene.solids = {plate(2, 0)};
  Simulation simulation(scene);
  simulation.step();
  EXPECT_EQ(simulation.totals().lost, 8);
}

/// A way that leaves by a periodic face beside the solid that it crosses is seen from both sides of that face.
TEST(Simulation, CountsWhatPassesThroughASolidAcrossPeriodicFaces) {
  for (const double vx : {0.0, 40.0, -40.0}) {
    Scene scene = test::block(1, 1e-2);
    scene.domain = Domain{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, Edge::periodic, Edge::periodic, Edge::closed};
    scene.bodies[0].placement.position = {vx > 0 ? 0.45 : -0.45, 0.45, -0.3};
    scene.bodies[0].velocity = {vx, 0.5 * std::abs(vx), -60};  // through the floor once it is past the faces of x and y
    Simulation simulation(scene);
    simulation.step();
    EXPECT_LT(static_cast<double>(simulation.particles().position.z[0]), -0.5);
    EXPECT_EQ(simulation.totals().lost, 1) << vx;
    EXPECT_EQ(simulation.health().escape.count, 1) << vx;
  }
  // One of the scene's own, which stands just beyond the face; one that a way over two periods meets in the second
  // alone.
  for (const auto& [at, vx] : {std::pair{-0.4, 25.0}, std::pair{0.0, 230.0}}) {
    Scene scene = test::block(1, 1e-2);
    scene.domain = Domain{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, Edge::periodic, Edge::open, Edge::open};
    scene.bodies[0].placement.position = {0.45, 0, 0};
    scene.bodies[0].velocity = {vx, 0, 0};
    Solid wall = plate(0.3, 0);
    wall.placement = {{at, 0, 0}, {0, 1, 0}, 90};
    scene.solids = {wall};
    Simulation simulation(scene);
    simulation.step();
    EXPECT_EQ(simulation.totals().lost, 1) << vx;
    EXPECT_EQ(simulation.health().passage.count, 1) << vx;
  }
}

TEST(Simulation, EndsWithASentenceWhenPositionsAreNoLongerFinite) {
  Scene scene = test::block(2);
  scene.gravity = {0, 0, -0.3 * static_cast<double>(std::numeric_limits<Real>::max())};
  scene.time.fixed_dt = 1e10;
  scene.time.end = 1e12;
  scene.output.frame_interval = 1e12;
  Simulation simulation(scene);
  try {
    for (int k = 0; k < 10; ++k) simulation.step();
    FAIL() << "no error";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("have no finite position"), std::string::npos) << e.what();
  }
}

TEST(Simulation, RefusesOverlappingBodies) {
  Scene scene = test::block(4);
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[1].label = "other";
  scene.bodies[1].placement.position = {0.02, 0, 0};
  EXPECT_EQ(refusal(scene), "bodies[0] \"block\" and bodies[1] \"other\" overlap");
  scene.bodies[1].placement.position = {0.4, 0, 0};  // side by side
  EXPECT_EQ(refusal(scene), "");
}

TEST(Simulation, RefusesLiquidInsideASolid) {
  Scene scene = test::block(4);
  Solid ball;
  ball.label = "ball";
  ball.shape = Sphere{0.12};
  scene.solids = {ball};
  EXPECT_NE(refusal(scene).find("bodies[0] \"block\" starts inside the solid \"ball\" ("), std::string::npos)
      << refusal(scene);
  // A plate has no inside, but its boundary particles may not coincide with the liquid's.
  scene.bodies[0].placement.position = {0.05, 0.05, 0.05};
  scene.solids = {plate(2, 0)};
  EXPECT_EQ(refusal(scene), "bodies[0] \"block\" starts inside the solid \"floor\" (16 of its particles)");
}

TEST(Simulation, RefusesLiquidOutsideTheDomain) {
  Scene scene = test::block(4);
  scene.domain = Domain{{0, -1, -1}, {1, 1, 1}};
  EXPECT_EQ(refusal(scene), "bodies[0] \"block\" starts outside the domain (32 of its particles)");
}

TEST(Simulation, RefusesAnEmitterInsideASolid) {
  Scene scene = test::block(2);
  scene.bodies[0].placement.position = {5, 5, 5};
  Emitter emitter;
  emitter.label = "spout";
  emitter.shape = Rectangle{0.2, 0.2};
  emitter.interval = 1;
  emitter.placement.position = {0.05, 0.05, 0};
  scene.emitters = {emitter};
  scene.solids = {plate(2, 0)};
  EXPECT_EQ(refusal(scene), "emitters[0] \"spout\" starts inside the solid \"floor\" (4 of its particles)");
}

TEST(Simulation, RefusesWhatDoesNotFitInMemory) {
  Scene scene = test::block(4);
  scene.bodies[0].shape = Box{{1e4, 1e4, 1e4}};
  const std::string said = refusal(scene);
  EXPECT_NE(said.find("the scene needs about"), std::string::npos) << said;
  EXPECT_NE(said.find("GiB"), std::string::npos);
}

TEST(Simulation, GivesEachForcesAcceleration) {
  Scene scene = test::block(5);
  scene.gravity = {0, 0, -9.81};
  scene.forces = {SurfaceFeature{}, SurfaceFeature{}};
  const Simulation simulation(scene);
  EXPECT_EQ(simulation.acceleration_names(),
            (std::vector<std::string>{"gravity", "viscosity", "pressure", "surface_feature", "surface_feature_2"}));
  EXPECT_EQ(simulation.acceleration("gravity")[7], (Vec3r{0, 0, Real(-9.81)}));
  EXPECT_EQ(simulation.acceleration("surface_feature")[0], simulation.acceleration("surface_feature_2")[0]);
  EXPECT_GT(length(simulation.acceleration("surface_feature")[0]), 0);
  EXPECT_EQ(length(simulation.acceleration("viscosity")[0]), 0);
  EXPECT_THROW(simulation.acceleration("magnetism"), Error);
}

TEST(Simulation, CountsTheStepsAboveABound) {
  Scene scene = test::block(3, 0.5);
  scene.bodies[0].velocity = {1, 0, 0};
  Simulation simulation(scene);
  simulation.step();
  EXPECT_EQ(simulation.last_step().bound, "fixed");
  EXPECT_EQ(simulation.last_step().overruled, "cfl");
  EXPECT_EQ(simulation.totals().overruled_steps, 1);
}

// What the account says must be what is there, emission and outflow included.
class EnergyAccountOf : public testing::TestWithParam<Pressure> {};
INSTANTIATE_TEST_SUITE_P(EverySolver, EnergyAccountOf, testing::Values(Iisph{}, Pcisph{}, Wcsph{}, Dfsph{}));

TEST_P(EnergyAccountOf, BalancesTheKineticEnergy) {
  Scene scene = test::column(6, 4);
  scene.time.end = 0.3;
  scene.domain->max.z = 2.4;
  scene.bodies[0].velocity = {0, 0, 1};
  scene.forces = {SurfaceFeature{}};
  scene.pressure = GetParam();
  Emitter jet;  // shot upwards, out of the open top
  jet.shape = Rectangle{0.3, 0.3};
  jet.placement.position = {0, 0, 1.8};
  jet.velocity = {0, 0, 5};
  jet.interval = 0.05;
  scene.emitters = {jet};
  Simulation simulation(scene);
  test::run(simulation);
  const EnergyAccount& account = simulation.totals().energy;
  EXPECT_GT(account.out, 0);
  EXPECT_GT(account.emitted, 0);
  EXPECT_GT(account.start, 0);
  EXPECT_NE(account.forces, 0);
  EXPECT_NE(account.pressure, 0);
  const double kinetic = test::kinetic_energy(simulation);
  EXPECT_NEAR(account.kinetic() / kinetic, 1, 1e-5);
  EXPECT_NEAR(simulation.last_step().kinetic_energy / kinetic, 1, 1e-12);
}

}  // namespace
}  // namespace sessile
