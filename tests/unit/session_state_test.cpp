#include "session_state.h"

#include <gtest/gtest.h>

#include <limits>

#include "schedule.h"
#include "sessile/checkpoint/checkpoint.h"
#include "sessile/core/error.h"
#include "sessile/scene/read.h"
#include "sessile/simulation.h"

namespace sessile::app {
namespace {

TEST(SessionState, ComesBackExactly) {
  SessionState state;
  state.frame_times = {0, 1.0 / 3, 0.1 + 0.2, 1e-300};
  state.stats_bytes = 0xfffffffffffff;
  state.stats_time = 2.0 / 3;
  state.wall_time = 1e7 / 3;
  const SessionState back = session_of(session_json(state));
  EXPECT_EQ(back.frame_times, state.frame_times);
  EXPECT_TRUE(back.surface_times.empty());
  EXPECT_EQ(back.stats_bytes, state.stats_bytes);
  EXPECT_EQ(back.stats_time, state.stats_time);
  EXPECT_FALSE(back.frame_due);
  EXPECT_EQ(back.wall_time, state.wall_time);
}

#ifndef SESSILE_DOUBLE
// A checkpoint of the first program that wrote any, in single precision, before it watched over its steps. Where the
// fields of a state change, their format's number has to grow, and this one be read on, or refused with a reason.
TEST(SessionState, OfTheFirstFormatIsReadOn) {
  const Checkpoint old = read_checkpoint(SESSILE_TEST_DATA "/format_1.checkpoint");
  const SessionState session = session_of(old.session);
  EXPECT_EQ(session.frame_times.size(), 4U);
  EXPECT_EQ(session.stats_bytes, 3136U);
  EXPECT_EQ(session.stability.retries, 0);
  EXPECT_EQ(session.stability.health.compressed_steps, 0);
  EXPECT_TRUE(session.stability.last_fault.empty());
  Simulation simulation(read_resolved_text(old.scene_json, "format_1.checkpoint").scene, old.state);
  EXPECT_EQ(simulation.particles().size(), 31U);
  EXPECT_EQ(simulation.totals().steps, 6);
  EXPECT_NEAR(simulation.time(), 0.03, 1e-12);
  simulation.step();
  EXPECT_NEAR(simulation.time(), 0.035, 1e-12);
}
#endif

TEST(SessionState, RefusesOtherText) {
  const std::string deep(3000, '[');
  for (const char* text : {"", "{", deep.c_str(), "[1]", "3", R"({"frame_times": ["x"]})", R"({"stats_bytes": -1})"}) {
    EXPECT_THROW(session_of(text), Error) << text;
  }
}

TEST(SessionState, HasNoMoreFramesThanSteps) {
  SessionState state;
  state.frame_times = {0, 1, 2, 3};
  EXPECT_EQ(session_of(session_json(state), 3).frame_times.size(), 4U);
  for (const std::int64_t steps :
       {std::int64_t{2}, std::int64_t{0}, std::int64_t{-1}, std::numeric_limits<std::int64_t>::min()}) {
    EXPECT_THROW(session_of(session_json(state), steps), Error) << steps;
  }
}

TEST(Schedule, GoesOnAsIfItHadNotStopped) {
  Schedule whole(0.1);
  for (int k = 0; k <= 300; ++k) {
    const double time = k * 0.007;
    Schedule second(0.1, whole.last());
    ASSERT_EQ(second.due(time), whole.due(time)) << time;
    ASSERT_EQ(second.is_done(time), whole.is_done(time)) << time;
    if (whole.due(time)) whole.done(time);
  }
  EXPECT_TRUE(Schedule(0.1, std::nullopt).due(0));
}

}  // namespace
}  // namespace sessile::app
