#include "sessile/time/time_step.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sessile {
namespace {

TimeSettings wide() {
  TimeSettings settings;
  settings.dt_min = 1e-9;
  settings.dt_max = 1e9;
  return settings;
}

TEST(TimeStep, EachBoundIsItsFormula) {
  MotionScale scale;
  scale.spacing = 0.1;
  scale.rest_density = 1000;

  MotionScale moving = scale;
  moving.speed = 3;
  EXPECT_EQ(choose_time_step(wide(), moving, 0).bound, "cfl");
  EXPECT_DOUBLE_EQ(choose_time_step(wide(), moving, 0).dt, 0.4 * 0.1 / 3);

  MotionScale sounding = moving;
  sounding.sound_speed = 50;
  EXPECT_EQ(choose_time_step(wide(), sounding, 0).bound, "sound");
  EXPECT_DOUBLE_EQ(choose_time_step(wide(), sounding, 0).dt, 0.4 * 0.1 / 53);

  MotionScale pushed = scale;
  pushed.acceleration = 9.81;
  EXPECT_EQ(choose_time_step(wide(), pushed, 0).bound, "force");
  EXPECT_DOUBLE_EQ(choose_time_step(wide(), pushed, 0).dt, 0.25 * std::sqrt(0.1 / 9.81));

  MotionScale viscous = scale;
  viscous.viscosity = 20;
  EXPECT_EQ(choose_time_step(wide(), viscous, 0).bound, "viscosity");
  EXPECT_DOUBLE_EQ(choose_time_step(wide(), viscous, 0).dt, 0.125 * 1000 * 0.01 / 20);
}

TEST(TimeStep, FollowsTheSolversEffort) {
  TimeSettings settings = wide();
  settings.dt_max = 8e-3;
  MotionScale scale;
  scale.spacing = 0.1;
  scale.rest_density = 1000;
  scale.solver_effort = 1;  // as much as it may take
  EXPECT_EQ(choose_time_step(settings, scale, 4e-3).bound, "growth");
  scale.solver_effort = 1.6;
  EXPECT_EQ(choose_time_step(settings, scale, 4e-3).bound, "solver");
  EXPECT_DOUBLE_EQ(choose_time_step(settings, scale, 4e-3).dt, 4e-3 / std::sqrt(1.6));
  scale.solver_effort = 10;  // at most by half
  EXPECT_DOUBLE_EQ(choose_time_step(settings, scale, 4e-3).dt, 2e-3);
  settings.fixed_dt = 4e-3;
  EXPECT_EQ(choose_time_step(settings, scale, 4e-3).dt, 4e-3);
}

TEST(TimeStep, CapillaryBoundIsTheTabledOneForWater) {
  // docs/model.md: dx = 1 mm 1.48 ms, 0.25 mm 0.185 ms, 0.1 mm 47 us, before the factor.
  TimeSettings settings = wide();
  settings.capillary_factor = 1;
  for (const auto& [dx, expected] : {std::pair{1e-3, 1.48e-3}, {0.25e-3, 0.185e-3}, {0.1e-3, 47e-6}}) {
    MotionScale scale;
    scale.spacing = dx;
    scale.rest_density = 998.2;
    scale.tension = 0.0728;
    const TimeStep step = choose_time_step(settings, scale, 0);
    EXPECT_EQ(step.bound, "capillary");
    EXPECT_NEAR(step.dt / expected, 1, 0.01);
  }
}

TEST(TimeStep, StaysWithinTheScenesBoundsAndSaysSo) {
  MotionScale scale;
  scale.spacing = 0.1;
  scale.rest_density = 1000;
  scale.speed = 1000;
  TimeSettings settings;
  settings.dt_min = 1e-3;
  settings.dt_max = 5e-3;
  const TimeStep fast = choose_time_step(settings, scale, 0);
  EXPECT_EQ(fast.bound, "dt_min");
  EXPECT_EQ(fast.dt, 1e-3);
  EXPECT_EQ(fast.overruled, "cfl");
  scale.speed = 0.1;
  EXPECT_EQ(choose_time_step(settings, scale, 0).bound, "dt_max");
  const TimeStep grown = choose_time_step(settings, scale, 2e-3);
  EXPECT_EQ(grown.bound, "growth");
  EXPECT_DOUBLE_EQ(grown.dt, 2e-3 * settings.growth);
  EXPECT_EQ(grown.overruled, "");
}

TEST(TimeStep, FixedStepSaysWhichBoundItExceeds) {
  MotionScale scale;
  scale.spacing = 0.1;
  scale.rest_density = 1000;
  scale.speed = 100;
  TimeSettings settings;
  settings.fixed_dt = 4e-3;
  EXPECT_EQ(choose_time_step(settings, scale, 1e-3).dt, 4e-3);
  EXPECT_EQ(choose_time_step(settings, scale, 1e-3).overruled, "cfl");
  scale.speed = 1;
  EXPECT_EQ(choose_time_step(settings, scale, 1e-3).overruled, "");
}

}  // namespace
}  // namespace sessile
