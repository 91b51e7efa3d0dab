#include "view/history.h"

#include <gtest/gtest.h>

#include <array>

namespace sessile::viewer {
namespace {

TEST(History, KeepsWhatItIsGiven) {
  History history({{"a", "m"}, {"b", ""}});
  history.add(0.5, std::array{1.0, 2.0});
  history.add(0.75, std::array{3.0, 4.0});
  EXPECT_EQ(history.times(), (std::vector{0.5, 0.75}));
  EXPECT_EQ(history.values(0), (std::vector{1.0, 3.0}));
  EXPECT_EQ(history.values(1), (std::vector{2.0, 4.0}));
}

TEST(History, IsBoundedAndEven) {
  History history({{"double", ""}}, 64);
  for (int k = 0; k < 10000; ++k) history.add(k, std::array{2.0 * k});
  const auto& times = history.times();
  EXPECT_LE(times.size(), 64U);
  EXPECT_GE(times.size(), 32U);
  EXPECT_EQ(times.front(), 0);
  EXPECT_GT(times.back(), 9600) << "the latest are missing";
  const double distance = times[1] - times[0];
  for (std::size_t k = 1; k < times.size(); ++k) EXPECT_EQ(times[k] - times[k - 1], distance);
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_EQ(history.values(0)[k], 2 * times[k]);
}

TEST(History, StartsAnewWhenTimeGoesBack) {
  History history({{"a", ""}}, 4);
  for (int k = 0; k < 100; ++k) history.add(k, std::array{1.0});
  history.add(0, std::array{2.0});
  history.add(1, std::array{3.0});
  EXPECT_EQ(history.times(), (std::vector{0.0, 1.0}));
  EXPECT_EQ(history.values(0), (std::vector{2.0, 3.0}));
}

}  // namespace
}  // namespace sessile::viewer
