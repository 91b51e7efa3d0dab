#include "sessile/scene/tuning.h"

#include <gtest/gtest.h>

#include "sessile/core/error.h"
#include "sessile/scene/describe.h"
#include "sessile/simulation.h"
#include "support/scenes.h"

namespace sessile {
namespace {

/// Liquid that falls on to a floor, with every kind of parameter that can change.
Scene splash() {
  Scene scene = test::block(5);
  scene.gravity = {0, 0, -9.81};
  scene.forces = {SurfaceFeature{}};
  scene.bodies[0].placement.position = {0, 0, 0.36};
  scene.bodies[0].velocity = {0, 0, -1};
  Solid floor;
  floor.label = "floor";
  floor.shape = Plate{2, 2};
  scene.solids = {floor};
  return scene;
}

std::string refusal(Simulation& simulation, const Scene& scene) {
  try {
    simulation.retune(scene);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

TEST(Tuning, KnowsWhatMayChangeBetweenSteps) {
  for (const char* path : {"title", "gravity", "time.fixed_dt", "time.end", "fluid.viscosity", "forces",
                           "forces[0].cohesion", "forces[3].type", "pressure.error", "solids[2].adhesion",
                           "solids[0].viscosity", "output.frame_interval", "output.fields"}) {
    EXPECT_TRUE(may_change_between_steps(path)) << path;
  }
  for (const char* path : {"spacing", "support", "fluid", "fluid.rest_density", "pressure", "pressure.type", "bodies",
                           "bodies[0].velocity", "emitters[0].interval", "domain", "domain.x", "solids",
                           "solids[0].spacing", "solids[0].placement.position", "timeless"}) {
    EXPECT_FALSE(may_change_between_steps(path)) << path;
  }
}

TEST(Tuning, MixesWhatMayChangeIntoTheRunningScene) {
  const Scene running = splash();
  Scene wanted = running;
  wanted.spacing = 0.2;
  wanted.gravity = {1, 2, 3};
  wanted.fluid = {900, 3};
  wanted.solids[0].adhesion = 2;
  wanted.solids[0].layers = 3;
  wanted.forces.emplace_back(Csf{});
  std::get<Iisph>(wanted.pressure).error = 0.5;
  Scene expected = running;
  expected.gravity = {1, 2, 3};
  expected.fluid.viscosity = 3;
  expected.solids[0].adhesion = 2;
  expected.forces = wanted.forces;
  std::get<Iisph>(expected.pressure).error = 0.5;
  const Scene mixed = tuned(running, wanted);
  EXPECT_EQ(to_json(mixed), to_json(expected));
  EXPECT_EQ(differing_parameters(mixed, wanted),
            (std::vector<std::string>{"spacing", "fluid.rest_density", "solids[0].layers"}));
}

TEST(Tuning, KeepsTheSolverAndTheNumberOfSolids) {
  const Scene running = splash();
  Scene wanted = running;
  wanted.pressure = Dfsph{};
  wanted.solids.push_back(wanted.solids[0]);
  EXPECT_EQ(to_json(tuned(running, wanted)), to_json(running));
}

TEST(Retune, WithoutAChangeIsAsIfItHadNotBeen) {
  for (const Pressure& pressure : {Pressure(Iisph{}), Pressure(Wcsph{}), Pressure(Dfsph{})}) {
    Scene scene = splash();
    scene.pressure = pressure;
    Simulation plain(scene), tuned_often(scene);
    for (int k = 0; k < 30; ++k) {
      tuned_often.retune(k % 2 == 0 ? scene : tuned_often.scene());
      plain.step();
      tuned_often.step();
    }
    EXPECT_EQ(plain.time(), tuned_often.time());
    EXPECT_EQ(plain.particles().position.z, tuned_often.particles().position.z);
    EXPECT_EQ(plain.particles().velocity.x, tuned_often.particles().velocity.x);
    EXPECT_EQ(to_json(plain.scene()), to_json(tuned_often.scene()));
  }
}

TEST(Retune, BeforeTheFirstStepIsTheSceneWithThoseValues) {
  Scene other = splash();
  other.gravity = {0, 0, -5};
  other.fluid.viscosity = 3;
  other.forces = {Akinci2013{}};
  other.solids[0].adhesion = 0.5;
  other.solids[0].viscosity = 1;
  other.time.fixed_dt = 1e-3;
  std::get<Iisph>(other.pressure).max_iterations = 9;
  Scene plain = splash();
  plain.forces.clear();  // so that normals are wanted only after the change
  Simulation changed(plain), direct(other);
  changed.retune(other);
  EXPECT_EQ(changed.normal().x, direct.normal().x);
  for (int k = 0; k < 20; ++k) {
    changed.step();
    direct.step();
  }
  EXPECT_EQ(changed.particles().position.z, direct.particles().position.z);
  EXPECT_EQ(changed.particles().velocity.x, direct.particles().velocity.x);
}

TEST(Retune, ChangesWhatFollows) {
  Scene scene = test::block(3);
  Simulation simulation(scene);
  simulation.step();
  scene.gravity = {0, 0, -10};
  simulation.retune(scene);
  simulation.step();
  EXPECT_NEAR(static_cast<double>(simulation.particles().velocity.z[0]), -10 * 2e-3, 1e-7);
}

TEST(Retune, RefusesWhatNeedsANewRunAndFaults) {
  Simulation simulation(splash());
  Scene scene = splash();
  scene.spacing = 0.05;
  scene.gravity = {};
  scene.solids[0].label = "ground";
  EXPECT_EQ(refusal(simulation, scene),
            "spacing: cannot change while the simulation runs, only from its start\n"
            "solids[0].label: cannot change while the simulation runs, only from its start");
  EXPECT_EQ(simulation.scene().gravity.z, -9.81) << "a refused change left something behind";
  scene = splash();
  scene.fluid.viscosity = -1;
  EXPECT_EQ(refusal(simulation, scene), "fluid.viscosity: must be at least 0 Pa s, found -1");
  scene = splash();
  scene.pressure = Wcsph{};
  EXPECT_NE(refusal(simulation, scene), "");
}

TEST(Retune, KeepsTheSpeedOfSoundThatWasFound) {
  Scene scene = splash();
  scene.pressure = Wcsph{};
  Simulation simulation(scene);
  const auto found = std::get<Wcsph>(simulation.scene().pressure).sound_speed;
  ASSERT_TRUE(found);
  simulation.retune(scene);
  EXPECT_EQ(std::get<Wcsph>(simulation.scene().pressure).sound_speed, found);
  std::get<Wcsph>(scene.pressure).sound_speed = 99;
  simulation.retune(scene);
  EXPECT_EQ(std::get<Wcsph>(simulation.scene().pressure).sound_speed, 99);
}

}  // namespace
}  // namespace sessile
