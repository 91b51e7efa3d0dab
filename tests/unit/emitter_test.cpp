#include "sessile/particles/emitter.h"

#include <gtest/gtest.h>

#include "support/scenes.h"

namespace sessile {
namespace {

Emitter spout() {
  Emitter emitter;
  emitter.shape = Rectangle{0.5, 0.5};
  emitter.velocity = {0, 0, -1};
  return emitter;
}

Scene with(const Emitter& emitter, double dt = 0.01) {
  Scene scene;
  scene.spacing = 0.1;
  scene.gravity = {};
  scene.time.end = 10;
  scene.time.fixed_dt = dt;
  scene.emitters = {emitter};
  return scene;
}

TEST(Emitter, LetsInLayersAtTheListedTimes) {
  Emitter emitter = spout();
  emitter.times = {0, 0.25, 0.5};
  Simulation simulation(with(emitter));
  EXPECT_EQ(simulation.particles().size(), 25u);
  while (simulation.time() < 0.245) simulation.step();
  EXPECT_EQ(simulation.particles().size(), 25u + 25u * (simulation.time() >= 0.25));
  while (simulation.time() < 0.3) simulation.step();
  EXPECT_EQ(simulation.particles().size(), 50u);
  while (simulation.time() < 2) simulation.step();
  EXPECT_EQ(simulation.particles().size(), 75u);
  EXPECT_EQ(simulation.totals().emitted, 75);
  EXPECT_EQ(simulation.totals().waits, 0);
  for (const Real v : simulation.particles().velocity.z) EXPECT_LT(v, Real(-0.5));
}

TEST(Emitter, EndsAtItsCountAndAtItsEnd) {
  Emitter emitter = spout();
  emitter.interval = 0.2;
  emitter.count = 3;
  Simulation counted(with(emitter));
  while (counted.time() < 2) counted.step();
  EXPECT_EQ(counted.totals().emitted, 75);
  emitter.count.reset();
  emitter.start = 0.1;
  emitter.end = 0.6;  // 0.1, 0.3, 0.5
  Simulation ended(with(emitter));
  EXPECT_EQ(ended.particles().size(), 0u);
  while (ended.time() < 2) ended.step();
  EXPECT_EQ(ended.totals().emitted, 75);
}

TEST(Emitter, ALayerWhosePlaceIsTakenWaitsAndIsCountedOnce) {
  Emitter emitter = spout();
  emitter.times = {0, 0.02};  // 2 cm further down is no room for a second layer
  Simulation simulation(with(emitter));
  while (simulation.time() < 0.05) simulation.step();
  EXPECT_EQ(simulation.particles().size(), 25u);
  EXPECT_EQ(simulation.totals().waits, 1);
  while (simulation.time() < 0.2) simulation.step();
  EXPECT_EQ(simulation.particles().size(), 50u);
  EXPECT_EQ(simulation.totals().waits, 1);
}

TEST(Emitter, NumbersParticlesOnAndOn) {
  Emitter emitter = spout();
  emitter.interval = 0.2;
  emitter.count = 4;
  Simulation simulation(with(emitter));
  while (simulation.time() < 1) simulation.step();
  std::vector<std::int64_t> ids(simulation.particles().id.begin(), simulation.particles().id.end());
  std::sort(ids.begin(), ids.end());
  for (std::size_t k = 0; k < ids.size(); ++k) EXPECT_EQ(ids[k], static_cast<std::int64_t>(k));
}

}  // namespace
}  // namespace sessile
