#include "view/live_run.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

#include "support/scenes.h"

namespace sessile::viewer {
namespace {

using namespace std::chrono_literals;

/// What a window would have gathered of a run: the newest of everything, and all samples.
struct Watcher {
  explicit Watcher(LiveRun& watched) : run(watched) {}

  /// Takes news until something holds; false when it does not within a minute, which no test should come near.
  bool until(const std::function<bool(const Watcher&)>& holds) {
    for (const auto start = std::chrono::steady_clock::now(); std::chrono::steady_clock::now() - start < 60s;) {
      look();
      if (holds(*this)) return true;
      std::this_thread::sleep_for(1ms);
    }
    return false;
  }
  void look() {
    LiveNews now = run.take();
    if (now.stage) {
      stage = std::move(now.stage);
      ++simulations;
      samples.clear();
    }
    for (const LiveSample& each : now.samples) samples.push_back(each);
    if (now.moment) moment = std::move(now.moment);
    if (now.scene) scene = std::move(now.scene);
    state = now.state;
    fault = now.fault;
  }
  std::int64_t steps() const { return samples.empty() ? -1 : samples.back().steps; }

  LiveRun& run;
  int simulations = 0;
  std::vector<LiveSample> samples;
  std::optional<draw::Moment> moment;
  std::optional<Scene> scene;
  std::optional<draw::Stage> stage;
  LiveState state = LiveState::paused;
  std::string fault;
};

const auto started = [](const Watcher& w) { return w.moment.has_value(); };
const auto steps_done = [](std::int64_t count) { return [count](const Watcher& w) { return w.steps() == count; }; };

TEST(LiveRun, ShowsTheStartAndWaits) {
  LiveRun run{Simulation(test::block(3))};
  Watcher watch(run);
  ASSERT_TRUE(watch.until(started));
  EXPECT_EQ(watch.moment->points.size(), 3 * 27U);
  EXPECT_EQ(watch.moment->values.size(), 27U);
  EXPECT_EQ(watch.moment->field, "speed");
  EXPECT_EQ(watch.moment->unit, "m/s");
  EXPECT_EQ(watch.moment->time, 0);
  std::this_thread::sleep_for(20ms);
  watch.look();
  EXPECT_EQ(watch.steps(), 0);
  EXPECT_EQ(watch.state, LiveState::paused);
  EXPECT_EQ(watch.simulations, 1);
  EXPECT_EQ(watch.stage->spacing, 0.1);
}

TEST(LiveRun, StepsExactlyAsOftenAsAsked) {
  LiveRun run{Simulation(test::block(3))};
  Watcher watch(run);
  run.step();
  ASSERT_TRUE(watch.until(steps_done(1)));
  std::this_thread::sleep_for(20ms);
  watch.look();
  EXPECT_EQ(watch.steps(), 1);
  run.step();
  run.step();
  run.step();
  ASSERT_TRUE(watch.until(steps_done(4)));
  std::this_thread::sleep_for(20ms);
  watch.look();
  EXPECT_EQ(watch.steps(), 4);
  EXPECT_NEAR(watch.moment->time, 4 * 2e-3, 1e-12);
}

TEST(LiveRun, IsTheSimulationThatRunsWithoutIt) {
  Scene scene = test::block(4);
  scene.gravity = {0, 0, -9.81};
  Simulation alone(scene);
  for (int k = 0; k < 5; ++k) alone.step();
  LiveRun run{Simulation(scene)};
  Watcher watch(run);
  for (int k = 0; k < 5; ++k) run.step();
  ASSERT_TRUE(watch.until(steps_done(5)));
  for (std::size_t k = 0; k < alone.particles().size(); ++k) {
    EXPECT_EQ(watch.moment->points[3 * k + 2], static_cast<float>(alone.particles().position.z[k]));
  }
}

TEST(LiveRun, PlaysPausesAndEnds) {
  LiveRun run{Simulation(test::block(3, 2e-3, 0.2))};
  Watcher watch(run);
  run.limit(0.5);
  run.play();
  ASSERT_TRUE(watch.until([](const Watcher& w) { return w.steps() >= 3; }));
  run.pause();
  ASSERT_TRUE(watch.until([](const Watcher& w) { return w.state == LiveState::paused; }));
  watch.look();
  const auto steps = watch.steps();
  EXPECT_LT(steps, 100);
  std::this_thread::sleep_for(30ms);
  watch.look();
  EXPECT_EQ(watch.steps(), steps);
  run.limit({});
  run.play();
  ASSERT_TRUE(watch.until([](const Watcher& w) { return w.state == LiveState::ended; }));
  ASSERT_TRUE(watch.until(steps_done(100)));
  EXPECT_NEAR(watch.moment->time, 0.2, 1e-9);
}

TEST(LiveRun, GoesOnWhenNobodyLooks) {
  LiveRun run{Simulation(test::block(3, 2e-3, 0.2))};
  run.limit({});
  run.play();
  Watcher watch(run);
  std::this_thread::sleep_for(300ms);
  ASSERT_TRUE(watch.until([](const Watcher& w) { return w.state == LiveState::ended; }));
  watch.look();
  EXPECT_EQ(watch.steps(), 100);
  EXPECT_NEAR(watch.moment->time, 0.2, 1e-9) << "not the newest moment";
}

TEST(LiveRun, StartsAnewFromAnotherScene) {
  LiveRun run{Simulation(test::block(3))};
  Watcher watch(run);
  run.step();
  ASSERT_TRUE(watch.until(steps_done(1)));
  run.reset(test::block(4));
  ASSERT_TRUE(watch.until([](const Watcher& w) { return w.simulations == 2 && w.steps() == 0; }));
  EXPECT_EQ(watch.moment->points.size(), 3 * 64U);
  EXPECT_GT(watch.stage->high.z, 0.1999);
  EXPECT_EQ(watch.state, LiveState::paused);
}

TEST(LiveRun, TellsWhyASceneCannotRunAndKeepsTheOneBefore) {
  LiveRun run{Simulation(test::block(3))};
  Watcher watch(run);
  Scene twice = test::block(3);
  twice.bodies.push_back(twice.bodies[0]);
  run.reset(twice);
  ASSERT_TRUE(watch.until([](const Watcher& w) { return !w.fault.empty(); }));
  EXPECT_NE(watch.fault.find("overlap"), std::string::npos) << watch.fault;
  run.step();
  ASSERT_TRUE(watch.until(steps_done(1)));
  EXPECT_EQ(watch.moment->points.size(), 3 * 27U);
}

TEST(LiveRun, TakesParametersBetweenSteps) {
  Scene scene = test::block(3);
  LiveRun run{Simulation(scene)};
  Watcher watch(run);
  run.step();
  ASSERT_TRUE(watch.until(steps_done(1)));
  EXPECT_EQ(watch.samples.back().max_speed, 0);
  scene.gravity = {0, 0, -10};
  run.change(scene);
  ASSERT_TRUE(watch.until([](const Watcher& w) { return w.scene && w.scene->gravity.z == -10; }));
  run.step();
  ASSERT_TRUE(watch.until(steps_done(2)));
  EXPECT_NEAR(watch.samples.back().max_speed, 10 * 2e-3, 1e-6);
  scene.spacing = 0.05;
  run.change(scene);
  ASSERT_TRUE(watch.until([](const Watcher& w) { return !w.fault.empty(); }));
  EXPECT_EQ(watch.fault, "spacing: cannot change while the simulation runs, only from its start");
}

TEST(LiveRun, TellsOfAStepThatFailsAndIsMendedByAReset) {
  const double huge = std::sqrt(static_cast<double>(std::numeric_limits<Real>::max()));
  Scene scene = test::block(3, 10 * huge, 100 * huge);  // dt^2 g is more than a Real holds
  scene.time.dt_max = 100 * huge;
  scene.output.frame_interval = huge;
  scene.gravity = {0, 0, -huge};
  LiveRun run{Simulation(scene)};
  Watcher watch(run);
  run.play();
  ASSERT_TRUE(watch.until([](const Watcher& w) { return w.state == LiveState::failed; }));
  EXPECT_NE(watch.fault.find("no finite position"), std::string::npos) << watch.fault;
  run.play();
  run.step();
  std::this_thread::sleep_for(10ms);
  watch.look();
  EXPECT_EQ(watch.state, LiveState::failed);
  run.reset(test::block(3));
  ASSERT_TRUE(watch.until([](const Watcher& w) { return w.state == LiveState::paused && w.fault.empty(); }));
  run.step();
  ASSERT_TRUE(watch.until(steps_done(1)));
}

TEST(LiveRun, ColoursByWhatIsAsked) {
  Scene scene = test::block(3);
  scene.forces = {SurfaceFeature{}};
  LiveRun run{Simulation(scene)};
  Watcher watch(run);
  for (const std::string field : {"density", "acceleration_surface_feature", "id", "normal", "height"}) {
    run.colour_by(field);
    ASSERT_TRUE(watch.until([&](const Watcher& w) { return w.moment && w.moment->field == field; })) << field;
    EXPECT_EQ(watch.moment->values.size(), 27U) << field;
  }
  EXPECT_EQ(watch.steps(), 0);
  run.colour_by("colour");
  run.step();
  ASSERT_TRUE(watch.until(steps_done(1)));
  EXPECT_EQ(watch.moment->field, "height") << "a field that is not there took the place of one that is";
  scene.forces.clear();
  run.colour_by("acceleration_surface_feature");
  ASSERT_TRUE(watch.until([](const Watcher& w) { return w.moment->field == "acceleration_surface_feature"; }));
  run.change(scene);
  ASSERT_TRUE(watch.until([&](const Watcher& w) { return w.moment && w.moment->field == "speed"; }));
}

TEST(LiveRun, EndsWhileItPlays) {
  LiveRun run{Simulation(test::block(4, 2e-3, 1e4))};
  run.limit({});
  run.play();
  std::this_thread::sleep_for(5ms);
}  // the destructor comes back, or the test runs out of time

}  // namespace
}  // namespace sessile::viewer
