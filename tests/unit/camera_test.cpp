#include "draw/camera.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace sessile::draw {
namespace {

/// Where a place lands in the picture, -1 to 1 along each axis, and in depth.
Vec3d project(const Camera& camera, const Vec3d& p, double aspect, double radius) {
  const auto times = [](const Matrix& m, const std::array<double, 4>& v) {
    std::array<double, 4> result{};
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t k = 0; k < 4; ++k) result[row] += static_cast<double>(m[4 * k + row]) * v[k];
    }
    return result;
  };
  const auto seen = times(camera.projection(aspect, radius), times(camera.view(), {p.x, p.y, p.z, 1}));
  return {seen[0] / seen[3], seen[1] / seen[3], seen[2] / seen[3]};
}

struct Extent {
  double left = 9, right = -9, bottom = 9, top = -9;
};

Extent extent_of_box(const Camera& camera, const Vec3d& low, const Vec3d& high, double aspect) {
  Extent extent;
  for (const double x : {low.x, high.x}) {
    for (const double y : {low.y, high.y}) {
      for (const double z : {low.z, high.z}) {
        const Vec3d at = project(camera, {x, y, z}, aspect, 2 * length(high - low) + length(camera.target - low));
        extent.left = std::min(extent.left, at.x);
        extent.right = std::max(extent.right, at.x);
        extent.bottom = std::min(extent.bottom, at.y);
        extent.top = std::max(extent.top, at.y);
        EXPECT_GT(at.z, -1);
        EXPECT_LT(at.z, 1);
      }
    }
  }
  return extent;
}

TEST(Camera, AxesArePerpendicularAndLookAtTheTarget) {
  for (const Vec3d& up : {Vec3d{0, 0, 1}, Vec3d{0, 1, 0}, Vec3d{1, 0, 0}, Vec3d{0.6, 0, -0.8}}) {
    Camera camera;
    camera.up = up;
    camera.target = {1, 2, 3};
    camera.distance = 4;
    camera.azimuth = 50;
    camera.elevation = 35;
    EXPECT_NEAR(length(camera.right()), 1, 1e-12);
    EXPECT_NEAR(dot(camera.right(), camera.upward()), 0, 1e-12);
    EXPECT_NEAR(dot(camera.right(), up), 0, 1e-12);
    EXPECT_GT(dot(camera.upward(), up), 0);
    EXPECT_NEAR(dot(camera.eye() - camera.target, up), 4 * std::sin(35 * M_PI / 180), 1e-12);
    const Vec3d middle = project(camera, camera.target, 1.5, 1);
    EXPECT_NEAR(middle.x, 0, 1e-6);
    EXPECT_NEAR(middle.y, 0, 1e-6);
  }
}

TEST(Camera, AzimuthZeroLooksAlongY) {
  Camera camera;
  camera.azimuth = 0;
  camera.elevation = 0;
  EXPECT_NEAR(length(camera.forward() - Vec3d{0, 1, 0}), 0, 1e-12);
  EXPECT_NEAR(length(camera.right() - Vec3d{1, 0, 0}), 0, 1e-12);
  camera.azimuth = 90;  // the eye moves to the right
  EXPECT_NEAR(length(camera.forward() - Vec3d{-1, 0, 0}), 0, 1e-12);
}

TEST(Camera, FitsABoxAsLargeAsItGoes) {
  for (const double scale : {1e-5, 1.0, 1e4}) {
    for (const bool orthographic : {false, true}) {
      for (const double aspect : {0.5, 1.0, 16.0 / 9}) {
        for (const double elevation : {-70.0, 5.0, 30.0, 85.0}) {
          Camera camera;
          camera.orthographic = orthographic;
          camera.elevation = elevation;
          const Vec3d low = scale * Vec3d{-1, 4, 2}, high = scale * Vec3d{3, 5, 2.5};
          camera.fit(low, high, aspect);
          const Extent seen = extent_of_box(camera, low, high, aspect);
          EXPECT_GT(seen.left, -0.96);
          EXPECT_LT(seen.right, 0.96);
          EXPECT_GT(seen.bottom, -0.96);
          EXPECT_LT(seen.top, 0.96);
          const bool fills = seen.right - seen.left > 1.86 || seen.top - seen.bottom > 1.86;
          EXPECT_TRUE(fills) << "aspect " << aspect << ", elevation " << elevation;
          EXPECT_NEAR(seen.left + seen.right, 0, orthographic ? 0.01 : 0.4);
        }
      }
    }
  }
}

TEST(Camera, KeepsTheBottomFreeForALegend) {
  Camera camera;
  const Vec3d low{-1, -1, -1}, high{1, 1, 1};
  camera.fit(low, high, 2, 0.2);
  const Extent seen = extent_of_box(camera, low, high, 2);
  EXPECT_GT(seen.bottom, -0.6);
  EXPECT_GT(seen.top, 0.8);
  EXPECT_LT(seen.top, 0.96);
}

TEST(Camera, FitsAFlatBoxAndKeepsTheDistanceForAPoint) {
  Camera camera;
  camera.fit({0, 0, 0}, {1, 1, 0}, 1);
  EXPECT_GT(camera.distance, 0.5);
  const double distance = camera.distance;
  camera.fit({2, 2, 2}, {2, 2, 2}, 1);
  EXPECT_EQ(camera.distance, distance);
  EXPECT_EQ(camera.target.x, 2);
}

TEST(Camera, OrbitsShortOfTheZenith) {
  Camera camera;
  camera.orbit(400, 500);
  EXPECT_LE(camera.elevation, 89.9);
  EXPECT_NEAR(std::remainder(camera.azimuth - 70, 360), 0, 1e-9);
  camera.orbit(0, -500);
  EXPECT_GE(camera.elevation, -89.9);
  EXPECT_TRUE(std::isfinite(length(camera.right())));
}

TEST(Camera, PanMovesWhatIsSeenByShares) {
  Camera camera;
  camera.distance = 3;
  const Vec3d before = camera.target;
  camera.pan(0.25, -0.5);
  const Vec3d at = project(camera, before, 2, 1);
  EXPECT_NEAR(at.x, 0.25, 1e-6);  // a quarter of the height is an eighth of the width: half of that in -1 .. 1
  EXPECT_NEAR(at.y, -1, 1e-6);
  camera.zoom(2);
  EXPECT_EQ(camera.distance, 1.5);
}

}  // namespace
}  // namespace sessile::draw
