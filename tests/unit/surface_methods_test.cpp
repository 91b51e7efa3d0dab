#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sessile/surface/manifold.h"
#include "sessile/surface/reconstruct.h"

/// What every method owes; surface_reconstruct_test.cpp holds the default to more.
namespace sessile::surface_methods_test {
namespace {

constexpr double spacing = 0.1;

SurfaceSettings with(SurfaceMethod method) {
  SurfaceSettings settings;
  settings.method = method;
  return settings;
}

std::vector<SurfaceSettings> every_method() {
  return {with(DensityField{}), with(AnisotropicKernels{}), with(MeanDistance{})};
}

Snapshot ball() {
  Snapshot points;
  for (int z = -9; z <= 9; ++z) {
    for (int y = -9; y <= 9; ++y) {
      for (int x = -9; x <= 9; ++x) {
        const Vec3d at{x + 0.31, y + 0.12, z - 0.23};
        if (length(at) > 8) continue;
        for (const double c : {at.x, at.y, at.z}) points.points.push_back(static_cast<float>(spacing * c));
      }
    }
  }
  return points;
}

Snapshot cloud(int n, double extent, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, extent * spacing);
  Snapshot points;
  for (int k = 0; k < 3 * n; ++k) points.points.push_back(static_cast<float>(place(random)));
  return points;
}

TEST(SurfaceMethods, BallHasItsVolume) {
  const Snapshot points = ball();
  const double volume = static_cast<double>(points.size()) * spacing * spacing * spacing;
  for (const SurfaceSettings& settings : every_method()) {
    const SurfaceMesh mesh = reconstruct(points, spacing, settings);
    EXPECT_NEAR(enclosed_volume(mesh) / volume, 1, 0.06) << settings.method.index();
    EXPECT_EQ(inspect(mesh).euler, 2) << settings.method.index();
  }
}

TEST(SurfaceMethods, CloudsAreClosedManifolds) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Snapshot points = cloud(700, 11, seed);
    for (const SurfaceSettings& settings : every_method()) {
      const MeshReport report = inspect(reconstruct(points, spacing, settings));
      EXPECT_TRUE(report.closed_manifold()) << settings.method.index() << ": " << report.bad_edges << ' '
                                            << report.bad_vertices << ' ' << report.bad_points;
    }
  }
}

TEST(SurfaceMethods, ScaleAndPlaceDoNotMatter) {
  const Snapshot points = cloud(300, 8, 1);
  for (const SurfaceSettings& settings : every_method()) {
    const SurfaceMesh mesh = reconstruct(points, spacing, settings);
    Snapshot small = points;
    for (float& x : small.points) x = std::ldexp(x, -60);
    const SurfaceMesh scaled = reconstruct(small, std::ldexp(spacing, -60), settings);
    EXPECT_EQ(scaled.triangles, mesh.triangles);
    for (std::size_t k = 0; k < mesh.points.size(); ++k) {
      ASSERT_EQ(scaled.points[k], std::ldexp(mesh.points[k], -60));
    }
  }
}

TEST(SurfaceMethods, FineAndCoarseCubesAgree) {
  const Snapshot points = ball();
  for (SurfaceSettings settings : every_method()) {
    settings.cube_size = 1;
    const double coarse = enclosed_volume(reconstruct(points, spacing, settings));
    settings.cube_size = 0.3;  // a kernel reaches over more than one block
    const SurfaceMesh fine = reconstruct(points, spacing, settings);
    EXPECT_NEAR(enclosed_volume(fine) / coarse, 1, 0.03) << settings.method.index();
    EXPECT_TRUE(inspect(fine).closed_manifold());
  }
}

TEST(SurfaceMethods, SmoothingEvensOutAndKeepsTheVolume) {
  const Snapshot points = ball();
  SurfaceSettings settings;
  settings.smoothing = 0;
  const SurfaceMesh rough = reconstruct(points, spacing, settings);
  settings.smoothing = 20;
  const SurfaceMesh even = reconstruct(points, spacing, settings);
  EXPECT_NEAR(enclosed_volume(even) / enclosed_volume(rough), 1, 0.01);
  EXPECT_LT(surface_area(even), surface_area(rough));
}

}  // namespace
}  // namespace sessile::surface_methods_test
