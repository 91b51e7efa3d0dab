#include <gtest/gtest.h>

#include <cstdint>
#include <set>

#include "sessile/core/error.h"
#include "support/same_bits.h"
#include "support/scenes.h"

namespace sessile {
namespace {

using test::beyond_all;

TEST(GoBack, GoesOnAsIfNothingHadHappened) {
  Scene scene = test::column(6, 4);
  scene.time.fixed_dt.reset();
  scene.forces = {SurfaceFeature{}};
  Simulation undisturbed(scene), disturbed(scene);
  for (int k = 0; k < 20; ++k) {
    undisturbed.step();
    disturbed.step();
  }
  const SimulationState good = disturbed.state();
  Scene wild = scene;
  wild.gravity = {0, 0, -beyond_all};
  wild.time.fixed_dt = 1e3;
  disturbed.retune(wild);
  EXPECT_THROW(disturbed.step(), RunError);
  EXPECT_GT(disturbed.health().not_finite.count, 0);
  disturbed.go_back_to(good);
  disturbed.retune(scene);
  EXPECT_EQ(disturbed.health().not_finite.count, 0);
  test::expect_same(undisturbed, disturbed, "after going back");
  for (int k = 0; k < 20; ++k) {
    undisturbed.step();
    disturbed.step();
  }
  test::expect_same(undisturbed, disturbed, "20 steps later");
}

/// Every particle that ever was is there or has left, and each only once.
void expect_balance(const Simulation& simulation, std::int64_t start) {
  const Totals& totals = simulation.totals();
  const auto& ids = simulation.particles().id;
  EXPECT_EQ(start + totals.emitted - totals.out, static_cast<std::int64_t>(ids.size()));
  const std::set<std::int64_t> distinct(ids.begin(), ids.end());
  EXPECT_EQ(distinct.size(), ids.size());
  if (!distinct.empty()) {
    EXPECT_GE(*distinct.begin(), 0);
    EXPECT_LT(*distinct.rbegin(), start + totals.emitted);
  }
}

TEST(Counts, BalanceInEveryKindOfDomain) {
  const Edge kinds[] = {Edge::open, Edge::closed, Edge::periodic};
  bool left = false, came = false;
  for (const Edge x : kinds) {
    for (const Edge z : kinds) {
      Scene scene = test::block(4, 5e-3);
      scene.gravity = {0, 0, -9.81};
      scene.bodies[0].velocity = {3, 1, 0};
      scene.domain = Domain{{-0.8, -0.8, -0.8}, {0.8, 0.8, 0.8}, x, Edge::open, z};
      Emitter jet;
      jet.shape = Rectangle{0.3, 0.3};
      jet.placement.position = {-0.4, 0, 0.5};
      jet.velocity = {4, 2, -4};
      jet.interval = 0.04;
      scene.emitters = {jet};
      Simulation simulation(scene);
      const std::int64_t start = static_cast<std::int64_t>(simulation.particles().size()) - simulation.totals().emitted;
      EXPECT_EQ(start, 64);
      for (int k = 0; k < 100; ++k) {
        simulation.step();
        expect_balance(simulation, start);
      }
      left = left || simulation.totals().out > 0;
      came = came || simulation.totals().emitted > 50;
    }
  }
  EXPECT_TRUE(left);
  EXPECT_TRUE(came);
}

TEST(Counts, ThatDoNotBalanceAreRefused) {
  Simulation simulation(test::block(3));
  SimulationState state = simulation.state();
  state.totals.out = 1;
  try {
    simulation.go_back_to(state);
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_NE(std::string(e.what()).find("do not add up: 27 of 27 are there and 1 have left"), std::string::npos)
        << e.what();
  }
}

/// NaN is neither below nor above a face: a particle of no place must never fall through the comparison.
TEST(Counts, KeepAParticleWithoutAPlace) {
  Scene scene = test::block(3);
  scene.domain = Domain{{-1, -1, -1}, {1, 1, 1}, Edge::open, Edge::open, Edge::open};
  scene.gravity = {0, 0, -beyond_all};
  scene.time.fixed_dt = 1e3;
  Simulation simulation(scene);
  EXPECT_THROW(simulation.step(), RunError);
  EXPECT_EQ(simulation.particles().size(), 27U);
  EXPECT_EQ(simulation.totals().out, 0);
}

}  // namespace
}  // namespace sessile
