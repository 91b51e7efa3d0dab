#include "sessile/measure/soundness.h"

#include <gtest/gtest.h>

#include "sessile/simulation.h"
#include "support/scenes.h"
#include "unit/scene_files.h"

namespace sessile {
namespace {

using test::has;

/// A calm run of 100 steps of 1 ms; `disturb` changes the state of each.
template <class F>
Soundness judged(F&& disturb, const SoundnessLimits& limits = {}) {
  Soundness soundness(limits);
  for (int step = 1; step <= 100; ++step) {
    SoundnessState state;
    state.time = 1e-3 * step;
    state.kinetic_energy = step <= 50 ? step : 100 - step;  // greatest: 50 J
    state.pressure_work = -0.1 * step;
    state.density_error = 5e-4;
    state.steps = state.solves = step;
    disturb(step, state);
    soundness.look(state);
  }
  soundness.finish();
  return soundness;
}

TEST(Soundness, OfACalmRun) {
  const Soundness s = judged([](int, SoundnessState&) {});
  EXPECT_TRUE(s.verdict().sound);
  EXPECT_EQ(s.verdict().reason, "");
  EXPECT_NEAR(s.density_error(), 5e-4, 1e-12);
  EXPECT_EQ(s.pressure_work_share(), 0);
  EXPECT_EQ(s.unconverged_share(), 0);
}

TEST(Soundness, EndsWithTheFirstLoss) {
  const Soundness s = judged([](int step, SoundnessState& state) { state.lost = step < 30 ? 0 : step < 40 ? 1 : 7; });
  EXPECT_FALSE(s.verdict().sound);
  EXPECT_NEAR(s.verdict().time, 0.030, 1e-12);
  EXPECT_EQ(s.verdict().reason, "a particle has passed through a solid");
}

TEST(Soundness, JudgesTheGreatestWorkOfPressureAtTheEnd) {
  // Against the greatest energy of the run, 50 J at step 50, though the work is done while there is little.
  const auto work = [](double joules) {
    return judged([=](int step, SoundnessState& state) { state.pressure_work = step == 8 ? joules : -1; });
  };
  EXPECT_TRUE(work(0.49).verdict().sound);
  EXPECT_NEAR(work(0.49).pressure_work_share(), 0.0098, 1e-12);
  const Verdict verdict = work(0.51).verdict();
  EXPECT_FALSE(verdict.sound);
  EXPECT_NEAR(verdict.time, 0.008, 1e-12);
  EXPECT_TRUE(has(verdict.reason, "pressure has put 0.51 J into the liquid, 1.02 % of the greatest kinetic energy"));
  EXPECT_TRUE(has(verdict.reason, "the limit is 1 %"));
}

TEST(Soundness, EndsWhenPressureRunsAway) {
  Soundness s;
  for (int step = 1; step <= 60; ++step) {
    SoundnessState state;
    state.time = step;
    state.steps = state.solves = step;
    state.kinetic_energy = 50;
    state.pressure_work = step == 10 ? 24 : step >= 55 ? 26 : 0;
    s.look(state);
    EXPECT_EQ(s.verdict().sound, step < 55);
  }
  EXPECT_TRUE(has(s.verdict().reason, "the limit is 50 %"));
}

TEST(Soundness, EndsWhenTooManySolvesMissTheirError) {
  Soundness s;
  for (int step = 1; step <= 60; ++step) {
    SoundnessState state;
    state.time = step;
    state.steps = state.solves = step;
    state.kinetic_energy = 50;
    state.unconverged_solves = step >= 10 ? 6 : 0;
    s.look(state);
    EXPECT_EQ(s.verdict().sound, step < 50);
  }
  EXPECT_EQ(s.verdict().reason, "6 of 50 pressure solves ended above their error, 12 %; the limit is 10 %");
}

TEST(Soundness, JudgesTheMeanDensityErrorAtTheEnd) {
  const auto error = [](double value) {
    return judged([=](int step, SoundnessState& state) { state.density_error = step % 2 ? 0 : 2 * value; });
  };
  EXPECT_TRUE(error(0.99e-3).verdict().sound);
  const Soundness over = error(1.01e-3);
  EXPECT_FALSE(over.verdict().sound);
  EXPECT_NEAR(over.verdict().time, 0.1, 1e-12);
  EXPECT_EQ(over.verdict().reason, "the mean density error is 0.101 %; the limit is 0.1 %");
  EXPECT_NEAR(over.density_error_max(), 2.02e-3, 1e-12);
}

TEST(Soundness, JudgesTheSolvesAtTheEnd) {
  const auto solves = [](int missed) {
    return judged([=](int step, SoundnessState& state) { state.unconverged_solves = step == 100 ? missed : 0; });
  };
  EXPECT_TRUE(solves(1).verdict().sound);
  EXPECT_EQ(solves(2).verdict().reason, "2 of 100 pressure solves ended above their error, 2 %; the limit is 1 %");
}

TEST(Soundness, KeepsTheFirstReason) {
  Soundness s = judged([](int step, SoundnessState& state) {
    state.lost = step >= 20 ? 2 : 0;
    state.pressure_work = step >= 30 ? 40 : 0;
    state.density_error = 1;
  });
  s.fail(0.2, "it blew up");
  EXPECT_EQ(s.verdict().reason, "particles have passed through a solid");
  EXPECT_NEAR(s.verdict().time, 0.020, 1e-12);
}

TEST(Soundness, OfAFailureIsItsMessage) {
  Soundness s;
  s.fail(0.5, "3 of 9 particles have no finite position");
  EXPECT_FALSE(s.verdict().sound);
  EXPECT_EQ(s.verdict().time, 0.5);
  EXPECT_EQ(s.verdict().reason, "3 of 9 particles have no finite position");
}

TEST(Soundness, LimitsAreParameters) {
  SoundnessLimits limits;
  limits.density_error = 1e-4;
  EXPECT_FALSE(judged([](int, SoundnessState&) {}, limits).verdict().sound);
  limits = {};
  limits.pressure_work = 0.4;
  const auto work = [](int step, SoundnessState& state) { state.pressure_work = step == 50 ? 15 : 0; };
  EXPECT_TRUE(judged(work, limits).verdict().sound);
  EXPECT_FALSE(judged(work).verdict().sound);
}

TEST(Soundness, ReadsASimulation) {
  Simulation liquid(test::block(4, 2e-3, 0.1));
  Soundness s;
  while (!liquid.finished()) {
    liquid.step();
    s.look(liquid);
  }
  s.finish();
  EXPECT_TRUE(s.verdict().sound) << s.verdict().reason;
}

}  // namespace
}  // namespace sessile
