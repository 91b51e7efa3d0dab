#include "sessile/measure/step_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace sessile {
namespace {

/// All places tried, in order, when `sound` answers each trial.
std::vector<StepTrial> searched(const StepSearch& search, const std::function<bool(int)>& sound) {
  std::vector<StepTrial> trials;
  while (const auto place = next_trial(search, trials)) {
    trials.push_back({*place, sound(*place)});
    if (trials.size() > 100) break;  // a search without an end fails below
  }
  return trials;
}

std::vector<int> places(const std::vector<StepTrial>& trials) {
  std::vector<int> result;
  for (const StepTrial& trial : trials) result.push_back(trial.place);
  return result;
}

TEST(StepSeries, IsOfRoundNumbers) {
  EXPECT_EQ(step_at(0), 1);
  EXPECT_EQ(step_at(5), 3.15);
  EXPECT_EQ(step_at(9), 8);
  EXPECT_EQ(step_at(10), 10);
  EXPECT_EQ(step_at(-1), 0.8);
  EXPECT_EQ(step_at(-10), 0.1);
  EXPECT_EQ(step_at(-11), 0.08);
  EXPECT_EQ(step_at(-24), 0.004);
  for (int place = -70; place < 20; ++place) EXPECT_LT(step_at(place), step_at(place + 1));
}

TEST(StepSeries, FindsPlaces) {
  for (int place = -60; place <= 10; ++place) {
    EXPECT_EQ(place_at_most(step_at(place)), place);
    EXPECT_EQ(place_at_least(step_at(place)), place);
    EXPECT_EQ(place_at_most(1.01 * step_at(place)), place);
    EXPECT_EQ(place_at_least(1.01 * step_at(place)), place + 1);
    EXPECT_EQ(place_at_least(0.99 * step_at(place)), place);
  }
}

TEST(StepSearch, GallopsUpThenHalves) {
  const auto trials = searched({-30, -60, 10}, [](int place) { return place <= -22; });
  EXPECT_EQ(places(trials), (std::vector<int>{-30, -27, -24, -21, -23, -22}));
  EXPECT_EQ(largest_sound(trials), -22);
}

TEST(StepSearch, GallopsDownThenHalves) {
  const auto trials = searched({-30, -60, 10}, [](int place) { return place <= -35; });
  EXPECT_EQ(places(trials), (std::vector<int>{-30, -33, -36, -35, -34}));
  EXPECT_EQ(largest_sound(trials), -35);
}

TEST(StepSearch, FindsEveryBoundFromEveryStart) {
  for (int start = -40; start <= 0; ++start) {
    for (int bound = -39; bound < 0; ++bound) {
      const auto trials = searched({start, -40, 0}, [=](int place) { return place <= bound; });
      EXPECT_EQ(largest_sound(trials), bound) << "from " << start;
      auto tried = places(trials);
      std::sort(tried.begin(), tried.end());
      EXPECT_EQ(std::adjacent_find(tried.begin(), tried.end()), tried.end()) << "a step was tried twice";
    }
  }
}

TEST(StepSearch, StopsAtItsLimits) {
  const auto all = searched({-5, -20, 0}, [](int) { return true; });
  EXPECT_EQ(places(all), (std::vector<int>{-5, -2, 0}));
  EXPECT_EQ(largest_sound(all), 0);
  const auto none = searched({-15, -20, 0}, [](int) { return false; });
  EXPECT_EQ(places(none), (std::vector<int>{-15, -18, -20}));
  EXPECT_FALSE(largest_sound(none));
  EXPECT_EQ(places(searched({7, -20, 0}, [](int) { return false; }))[0], 0);
  EXPECT_EQ(places(searched({-70, -20, 0}, [](int) { return false; })), (std::vector<int>{-20}));
  EXPECT_TRUE(searched({0, 5, 4}, [](int) { return true; }).empty());
}

TEST(StepSearch, TakesTheLeastUnsoundStepForTheBound) {
  const std::vector<StepTrial> trials{{-10, true}, {-7, false}, {-8, true}, {-9, false}};
  EXPECT_EQ(largest_sound(trials), -10);
  EXPECT_FALSE(next_trial({-10, -20, 0}, trials));
}

}  // namespace
}  // namespace sessile
