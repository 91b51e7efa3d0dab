#include "sessile/surface/reconstruct.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "sessile/core/error.h"
#include "sessile/surface/manifold.h"

namespace sessile::surface_reconstruct_test {
namespace {

constexpr double spacing = 0.1;

void add(Snapshot& to, const Vec3d& x) {
  for (const double c : {x.x, x.y, x.z}) to.points.push_back(static_cast<float>(c));
}

/// Points of a cubic lattice within a ball around a point that is on none of its planes of symmetry.
Snapshot lattice_ball(double radius_over_spacing) {
  Snapshot ball;
  const int reach = static_cast<int>(radius_over_spacing) + 1;
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const Vec3d at{x + 0.31, y + 0.12, z - 0.23};
        if (length(at) < radius_over_spacing) add(ball, spacing * at);
      }
    }
  }
  return ball;
}

Snapshot film(int edge, double stretch, double jitter) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  Snapshot points;
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      add(points, spacing * Vec3d{stretch * x + shift(random), stretch * y + shift(random), 0.3 + shift(random)});
    }
  }
  return points;
}

Snapshot random_cloud(int n, double extent, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, extent * spacing);
  Snapshot points;
  for (int i = 0; i < n; ++i) add(points, {place(random), place(random), place(random)});
  return points;
}

SurfaceMesh surface_of(const Snapshot& points) { return reconstruct(points, spacing, SurfaceSettings{}); }

double particle_volume(const Snapshot& points) {
  return static_cast<double>(points.size()) * spacing * spacing * spacing;
}

TEST(SurfaceReconstruct, BallHasItsVolumeAndArea) {
  for (const double radius : {8., 9., 10.}) {
    const Snapshot ball = lattice_ball(radius);
    const SurfaceMesh mesh = surface_of(ball);
    const double volume = particle_volume(ball);
    const double r = std::cbrt(volume * 3 / 4 / std::numbers::pi), area = 4 * std::numbers::pi * r * r;
    EXPECT_NEAR(enclosed_volume(mesh) / volume, 1, 0.03) << radius;
    EXPECT_NEAR(surface_area(mesh) / area, 1, 0.05) << radius;
    const MeshReport report = inspect(mesh);
    EXPECT_TRUE(report.closed_manifold());
    EXPECT_EQ(report.pieces, 1u);
    EXPECT_EQ(report.euler, 2);
  }
}

TEST(SurfaceReconstruct, FilmOneParticleThickIsOneSheetWithoutHoles) {
  for (const double stretch : {1., 1.1, 1.2}) {
    for (const double jitter : {0., 0.1, 0.2}) {
      const Snapshot points = film(20, stretch, jitter);
      const SurfaceMesh mesh = surface_of(points);
      const MeshReport report = inspect(mesh);
      EXPECT_TRUE(report.closed_manifold());
      EXPECT_EQ(report.pieces, 1u) << stretch << ' ' << jitter;
      EXPECT_EQ(report.euler, 2) << stretch << ' ' << jitter;
      EXPECT_NEAR(enclosed_volume(mesh) / (particle_volume(points) * stretch * stretch), 1, 0.4);
    }
  }
}

TEST(SurfaceReconstruct, LoneParticleIsADrop) {
  Snapshot one;
  add(one, {0.2, -3, 0.7});
  const SurfaceMesh mesh = surface_of(one);
  EXPECT_GT(enclosed_volume(mesh), 0.3 * particle_volume(one));
  EXPECT_LT(enclosed_volume(mesh), 1.5 * particle_volume(one));
  EXPECT_EQ(inspect(mesh).euler, 2);
}

TEST(SurfaceReconstruct, RandomCloudsAreClosedManifolds) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    const SurfaceMesh mesh = surface_of(random_cloud(400 << seed % 4, 10, seed));
    const MeshReport report = inspect(mesh);
    EXPECT_TRUE(report.closed_manifold()) << report.bad_edges << ' ' << report.bad_vertices << ' ' << report.bad_points;
    EXPECT_GT(enclosed_volume(mesh), 0);
  }
}

TEST(SurfaceReconstruct, NothingHasNoSurface) {
  const SurfaceMesh mesh = surface_of({});
  EXPECT_EQ(mesh.vertex_count(), 0u);
  EXPECT_EQ(mesh.triangle_count(), 0u);
}

TEST(SurfaceReconstruct, StrayIsMeshedWhereItIs) {
  Snapshot points = lattice_ball(3);
  const SurfaceMesh alone = surface_of(points);
  add(points, {-1e6 * spacing, 3e5 * spacing, 0});
  const SurfaceMesh both = surface_of(points);
  const MeshReport report = inspect(both);
  EXPECT_TRUE(report.closed_manifold());
  EXPECT_EQ(report.pieces, 2u);
  EXPECT_LT(both.vertex_count(), alone.vertex_count() + 1000);
  double low = 0;
  for (std::size_t k = 0; k < both.points.size(); k += 3) low = std::min<double>(low, both.points[k]);
  EXPECT_NEAR(low, -1e6 * spacing - 0.6 * spacing, 0.2 * spacing);
}

TEST(SurfaceReconstruct, ThreadsGiveTheSameBits) {
  Snapshot points = random_cloud(3000, 14, 3);
  points.columns.push_back({"height", "m", 1, std::vector<float>(points.size(), 1)});
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const SurfaceMesh one = surface_of(points);
  for (const int threads : {2, 8}) {
    omp_set_num_threads(threads);
    const SurfaceMesh more = surface_of(points);
    EXPECT_EQ(one.points, more.points);
    EXPECT_EQ(one.normals, more.normals);
    EXPECT_EQ(one.triangles, more.triangles);
    EXPECT_EQ(one.columns[0].values, more.columns[0].values);
  }
  omp_set_num_threads(before);
}

TEST(SurfaceReconstruct, PlacesThatAreNotFiniteAreRefused) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Snapshot points = lattice_ball(2);
    points.points[7] = bad;
    EXPECT_THROW(surface_of(points), Error);
  }
}

TEST(SurfaceReconstruct, CarriesColumns) {
  Snapshot points = lattice_ball(5);
  std::vector<float> velocity, constant(points.size(), 3.5f);
  std::vector<std::int64_t> id;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) velocity.push_back(2 * points.points[3 * i + k]);
    id.push_back(static_cast<std::int64_t>(i) + (std::int64_t{1} << 40));
  }
  points.columns = {{"velocity", "m/s", 3, velocity}, {"mass", "kg", 1, constant}, {"id", "", 1, id}};
  points.time = 2.5;
  points.step = 7;
  const SurfaceMesh mesh = surface_of(points);
  EXPECT_EQ(mesh.time, 2.5);
  EXPECT_EQ(mesh.step, 7);
  ASSERT_EQ(mesh.columns.size(), 3u);
  EXPECT_EQ(mesh.columns[0].unit, "m/s");
  const auto& carried_velocity = std::get<std::vector<float>>(mesh.columns[0].values);
  const auto& carried_mass = std::get<std::vector<float>>(mesh.columns[1].values);
  const auto& carried_id = std::get<std::vector<std::int64_t>>(mesh.columns[2].values);
  ASSERT_EQ(carried_velocity.size(), mesh.points.size());
  ASSERT_EQ(carried_id.size(), mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_NEAR(carried_mass[v], 3.5, 1e-4);
    const auto nearest = static_cast<std::size_t>(carried_id[v] - (std::int64_t{1} << 40));
    double distance2 = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(carried_velocity[3 * v + k], 2 * mesh.points[3 * v + k], 2.2 * spacing);
      distance2 += std::pow(mesh.points[3 * v + k] - points.points[3 * nearest + k], 2);
    }
    EXPECT_LT(std::sqrt(distance2), spacing);
  }
}

}  // namespace
}  // namespace sessile::surface_reconstruct_test
