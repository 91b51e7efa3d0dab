#include "session_state.h"

#include <gtest/gtest.h>

#include "schedule.h"
#include "sessile/core/error.h"

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

TEST(SessionState, RefusesOtherText) {
  for (const char* text : {"", "{", "[1]", "3", R"({"frame_times": ["x"]})", R"({"stats_bytes": -1})"}) {
    EXPECT_THROW(session_of(text), Error) << text;
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
