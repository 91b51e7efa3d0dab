#include "draw/color_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sessile::draw {
namespace {

double distance(const OkLab& p, const OkLab& q) { return std::hypot(p.lightness - q.lightness, p.a - q.a, p.b - q.b); }

TEST(ColorMap, OklabGoesThereAndBack) {
  for (const Rgb& color : {Rgb{0, 0, 0}, Rgb{1, 1, 1}, Rgb{0.2, 0.7, 0.4}, Rgb{1, 0, 0}}) {
    const Rgb back = to_rgb(to_oklab(color));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[k], color[k], 1e-4);
  }
  EXPECT_NEAR(to_oklab({1, 1, 1}).lightness, 1, 1e-4);
}

TEST(ColorMap, StepsLookEquallyLarge) {
  constexpr int count = 65;
  const auto colors = color_map(count);
  ASSERT_EQ(colors.size(), static_cast<std::size_t>(count));
  double sum = 0, least = 1, greatest = 0, least_lighter = 1, greatest_lighter = 0;
  for (std::size_t k = 1; k < colors.size(); ++k) {
    const OkLab from = to_oklab(colors[k - 1]), to = to_oklab(colors[k]);
    const double step = distance(from, to), lighter = to.lightness - from.lightness;
    sum += step;
    least = std::min(least, step);
    greatest = std::max(greatest, step);
    least_lighter = std::min(least_lighter, lighter);
    greatest_lighter = std::max(greatest_lighter, lighter);
  }
  const double mean = sum / (count - 1);
  EXPECT_GT(least, 0.93 * mean);
  EXPECT_LT(greatest, 1.07 * mean);
  EXPECT_GT(least_lighter, 0);
  EXPECT_GT(least_lighter, 0.6 * greatest_lighter);
}

TEST(ColorMap, EndsAreFarApartInLightness) {
  const auto colors = color_map(2);
  EXPECT_LT(to_oklab(colors.front()).lightness, 0.45);
  EXPECT_GT(to_oklab(colors.back()).lightness, 0.9);
}

}  // namespace
}  // namespace sessile::draw
