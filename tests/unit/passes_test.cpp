#include "sessile/measure/passes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "support/scenes.h"

namespace sessile {
namespace {

const Pass& pass(std::string_view name) {
  for (const Pass& each : passes()) {
    if (each.name == name) return each;
  }
  throw std::out_of_range(std::string(name));
}

/// What a pass computes by itself is what the step computed.
TEST(MeasuredPasses, AreThoseOfAStep) {
  Scene scene = test::block(8);
  scene.forces = {SurfaceFeature{}};
  Simulation simulation(scene);
  for (int k = 0; k < 3; ++k) simulation.step();
  PassScratch scratch;
  pass("density").run(simulation, scratch);
  EXPECT_EQ(scratch.numbers, simulation.density());
  pass("normals").run(simulation, scratch);
  EXPECT_EQ(scratch.pressure.acceleration.x, simulation.normal().x);
  PassScratch tension;
  pass("surface feature").run(simulation, tension);
  EXPECT_EQ(tension.vectors.z, simulation.acceleration("surface_feature").z);
}

TEST(MeasuredPasses, LeaveFiniteNumbersAndSayWhatTheyNeed) {
  Simulation simulation(test::block(6));
  PassScratch scratch;
  for (const Pass& each : passes()) {
    each.run(simulation, scratch);
    each.run(simulation, scratch);
    EXPECT_GT(each.work.gathered, 0) << each.name;
    EXPECT_GT(each.work.operations, 0) << each.name;
    EXPECT_GT(each.work.streamed, 0) << each.name;
  }
  for (const Real a : scratch.vectors.x) EXPECT_TRUE(std::isfinite(a));
  for (const Real change : scratch.numbers) EXPECT_TRUE(std::isfinite(change));
}

/// Each stage of a step reads the clock at its start and its end, and no more.
TEST(StageTimes, CountTheirClockReadings) {
  Simulation simulation(test::block(4));
  simulation.step();
  const StageTimes before = simulation.stage_times();
  simulation.step();
  const StageTimes after = simulation.stage_times();
  // forces, time step, v*, pressure, motion, emitters, neighbours, densities
  EXPECT_EQ(after.clock_reads - before.clock_reads, 16);
  EXPECT_GE(after.sum(), before.sum());
}

}  // namespace
}  // namespace sessile
