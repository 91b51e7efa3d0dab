#include <gtest/gtest.h>

#include <numbers>

#include "sessile/scene/sampling.h"

namespace sessile::test {
namespace {

SolidGeometry geometry(const SolidShape& shape, const Placement& placement = {}) {
  Solid solid;
  solid.shape = shape;
  solid.placement = placement;
  return SolidGeometry(solid);
}

TEST(SolidGeometry, Box) {
  const auto box = geometry(Box{{2, 2, 2}});
  EXPECT_TRUE(box.contains({0.99, 0, 0}));
  EXPECT_FALSE(box.contains({1, 0, 0}));  // its surface is no matter
  EXPECT_TRUE(box.crossed({-2, 0, 0}, {0, 0, 0}));
  EXPECT_TRUE(box.crossed({-2, 0, 0}, {2, 0.5, 0}));  // right through, in one step
  EXPECT_FALSE(box.crossed({-2, 0, 0}, {-1.5, 0, 0}));
  EXPECT_FALSE(box.crossed({0, 0, 0}, {2, 0, 0}));     // out of it
  EXPECT_FALSE(box.crossed({-2, 1, 0}, {2, 1, 0}));    // along a face
  EXPECT_FALSE(box.crossed({-2, 0, 0}, {0, 2.1, 0}));  // past an edge
}

TEST(SolidGeometry, Container) {
  const auto container = geometry(Container{{2, 2, 2}});
  EXPECT_FALSE(container.contains({0.9, 0, 0}));
  EXPECT_TRUE(container.contains({1.1, 0, 0}));
  EXPECT_TRUE(container.crossed({0.9, 0, 0}, {1.1, 0, 0}));
  EXPECT_FALSE(container.crossed({0.8, 0, 0}, {0.9, 0, 0}));
  EXPECT_FALSE(container.crossed({1.1, 0, 0}, {0.9, 0, 0}));
}

TEST(SolidGeometry, Plate) {
  const auto plate = geometry(Plate{2, 4}, {{0, 0, 1}, {0, 0, 1}, 0});
  EXPECT_FALSE(plate.contains({0, 0, 1}));
  EXPECT_TRUE(plate.crossed({0, 0, 1.1}, {0, 0, 0.9}));
  EXPECT_TRUE(plate.crossed({0, 0, 0.9}, {0, 0, 1.1}));
  EXPECT_FALSE(plate.crossed({0, 0, 1.2}, {0, 0, 1.1}));
  EXPECT_TRUE(plate.crossed({0, 1.9, 1.1}, {0, 1.9, 0.9}));
  EXPECT_FALSE(plate.crossed({1.1, 0, 1.1}, {1.1, 0, 0.9}));
  EXPECT_FALSE(plate.crossed({0.9, 0, 2}, {1.3, 0, 0}));  // meets the plane beside it
}

TEST(SolidGeometry, Ball) {
  const auto ball = geometry(Sphere{1}, {{3, 0, 0}, {0, 0, 1}, 0});
  EXPECT_TRUE(ball.contains({3.5, 0.5, 0.5}));
  EXPECT_FALSE(ball.contains({3.7, 0.7, 0.7}));
  EXPECT_TRUE(ball.crossed({0, 0, 0}, {6, 0, 0}));
  EXPECT_FALSE(ball.crossed({0, 1.01, 0}, {6, 1.01, 0}));
  EXPECT_FALSE(ball.crossed({3, 0, 0}, {6, 0, 0}));
}

TEST(SolidGeometry, Cylinder) {
  const auto cylinder = geometry(Cylinder{1, 4}, {{0, 0, 0}, {1, 0, 0}, 90});  // lies along y
  EXPECT_TRUE(cylinder.contains({0, 1.9, 0}));
  EXPECT_FALSE(cylinder.contains({0, 0, 1.1}));
  EXPECT_TRUE(cylinder.crossed({0, 3, 0}, {0, 1, 0}));
  EXPECT_TRUE(cylinder.crossed({2, 0, 0}, {-2, 0, 0}));
  EXPECT_FALSE(cylinder.crossed({2, 0, 0}, {0, 6, 0}));
  EXPECT_FALSE(cylinder.crossed({2, 3, 0}, {-2, 3, 0}));
}

TEST(SolidGeometry, BoundsHoldTheTurnedSolid) {
  const auto box = geometry(Box{{2, 2, 2}}, {{10, 0, 0}, {0, 0, 1}, 45});
  EXPECT_NEAR(box.lower().x, 10 - std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(box.upper().y, std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(box.upper().z, 1, 1e-12);
}

TEST(SolidGeometry, IsTheSameAtEveryScale) {
  for (const double s : {1e-6, 1.0, 1e4}) {
    for (const SolidShape& shape :
         {SolidShape(Box{{2 * s, 2 * s, 2 * s}}), SolidShape(Sphere{s}), SolidShape(Cylinder{s, 2 * s})}) {
      const auto solid = geometry(shape, {{s, s, s}, {1, 2, 3}, 33});
      EXPECT_TRUE(solid.contains({s, s, s + 0.9 * s}));
      EXPECT_FALSE(solid.contains({s, s, 3 * s}));
      EXPECT_TRUE(solid.crossed({s, s, 3 * s}, {s, s, -s}));
    }
  }
}

}  // namespace
}  // namespace sessile::test
