#include "sessile/surface/decimate.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sessile/surface/manifold.h"
#include "sessile/surface/reconstruct.h"

namespace sessile {
namespace {

constexpr double spacing = 0.1;

void add(Snapshot& to, const Vec3d& x) {
  for (const double c : {x.x, x.y, x.z}) to.points.push_back(static_cast<float>(c));
}

Snapshot lattice_ball(int radius_over_spacing) {
  Snapshot ball;
  for (int z = -radius_over_spacing; z <= radius_over_spacing; ++z) {
    for (int y = -radius_over_spacing; y <= radius_over_spacing; ++y) {
      for (int x = -radius_over_spacing; x <= radius_over_spacing; ++x) {
        const Vec3d at{x + 0.31, y + 0.12, z - 0.23};
        if (length(at) < radius_over_spacing) add(ball, spacing * at);
      }
    }
  }
  return ball;
}

Snapshot film(int edge, double jitter) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  Snapshot points;
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      add(points, spacing * Vec3d{1.1 * x + shift(random), 1.1 * y + shift(random), 0.3 + shift(random)});
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

SurfaceMesh surface_of(const Snapshot& points, double decimation, double error = SurfaceSettings{}.decimation_error) {
  SurfaceSettings settings;
  settings.decimation = decimation;
  settings.decimation_error = error;
  return reconstruct(points, spacing, settings);
}

double particle_volume(const Snapshot& points) {
  return static_cast<double>(points.size()) * spacing * spacing * spacing;
}

/// Triangles of `mesh` over those of `all`.
double share_left(const SurfaceMesh& mesh, const SurfaceMesh& all) {
  return static_cast<double>(mesh.triangle_count()) / static_cast<double>(all.triangle_count());
}

TEST(SurfaceDecimate, BallKeepsItsVolumeAndArea) {
  const Snapshot ball = lattice_ball(9);
  const SurfaceMesh all = surface_of(ball, 0), mesh = surface_of(ball, 0.8);
  const double volume = particle_volume(ball);
  const double r = std::cbrt(volume * 3 / 4 / std::numbers::pi), area = 4 * std::numbers::pi * r * r;
  EXPECT_LT(share_left(mesh, all), 0.35);
  EXPECT_NEAR(enclosed_volume(mesh) / volume, 1, 0.03);
  EXPECT_NEAR(surface_area(mesh) / area, 1, 0.05);
  const MeshReport report = inspect(mesh);
  EXPECT_TRUE(report.closed_manifold());
  EXPECT_EQ(report.pieces, 1u);
  EXPECT_EQ(report.euler, 2);
}

TEST(SurfaceDecimate, NoneChangesNoBit) {
  SurfaceMesh mesh = surface_of(random_cloud(400, 9, 1), 0);
  const SurfaceMesh before = mesh;
  decimate(mesh, 0, 1);
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(mesh.normals, before.normals);
  EXPECT_EQ(mesh.triangles, before.triangles);
}

TEST(SurfaceDecimate, FilmStaysOneSheet) {
  for (const double jitter : {0., 0.1}) {
    const Snapshot points = film(20, jitter);
    const SurfaceMesh all = surface_of(points, 0), mesh = surface_of(points, 0.8);
    const MeshReport report = inspect(mesh);
    EXPECT_LT(share_left(mesh, all), 0.5) << jitter;
    EXPECT_TRUE(report.closed_manifold());
    EXPECT_EQ(report.pieces, 1u);
    EXPECT_EQ(report.euler, 2);
    EXPECT_NEAR(enclosed_volume(mesh) / enclosed_volume(all), 1, 0.02);
  }
}

TEST(SurfaceDecimate, LoneDropsStayWhereAStrayIsFarAway) {
  Snapshot points = lattice_ball(5);
  for (int k = 0; k < 5; ++k) add(points, spacing * Vec3d{12. + 4 * k, 0.3 * k, 2});
  const SurfaceMesh near = surface_of(points, 0.9);
  const double volume = enclosed_volume(surface_of(points, 0));
  add(points, {-1e6 * spacing, 3e5 * spacing, 0});
  const SurfaceMesh far = surface_of(points, 0.9);
  EXPECT_EQ(inspect(near).pieces, 6u);
  EXPECT_NEAR(enclosed_volume(near) / volume, 1, 0.02);
  const MeshReport report = inspect(far);
  EXPECT_TRUE(report.closed_manifold());
  EXPECT_EQ(report.pieces, 7u);
  EXPECT_EQ(report.euler, 14);
  EXPECT_LT(far.triangle_count(), near.triangle_count() + 500);
}

TEST(SurfaceDecimate, TheErrorBoundsIt) {
  const Snapshot ball = lattice_ball(7);
  const SurfaceMesh all = surface_of(ball, 0);
  const SurfaceMesh fine = surface_of(ball, 0.99, 0.01), coarse = surface_of(ball, 0.99, 0.1);
  EXPECT_LT(share_left(coarse, fine), 0.7);
  EXPECT_LT(std::abs(enclosed_volume(fine) / enclosed_volume(all) - 1), 0.005);
}

TEST(SurfaceDecimate, RandomCloudsStayClosedManifolds) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Snapshot points = random_cloud(400 << seed, 10, seed);
    const SurfaceMesh all = surface_of(points, 0);
    for (const double share : {0.5, 0.9, 0.99}) {
      const SurfaceMesh mesh = surface_of(points, share);
      const MeshReport report = inspect(mesh), before = inspect(all);
      EXPECT_TRUE(report.closed_manifold()) << report.bad_edges << ' ' << report.bad_vertices;
      EXPECT_EQ(report.pieces, before.pieces);
      EXPECT_EQ(report.euler, before.euler);
      EXPECT_LT(share_left(mesh, all), 0.75) << seed << ' ' << share;
    }
  }
}

TEST(SurfaceDecimate, ThreadsGiveTheSameBits) {
  const Snapshot points = random_cloud(1500, 14, 3);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const SurfaceMesh one = surface_of(points, 0.8);
  for (const int threads : {2, 8}) {
    omp_set_num_threads(threads);
    const SurfaceMesh more = surface_of(points, 0.8);
    EXPECT_EQ(one.points, more.points);
    EXPECT_EQ(one.normals, more.normals);
    EXPECT_EQ(one.triangles, more.triangles);
  }
  omp_set_num_threads(before);
}

TEST(SurfaceDecimate, NormalsAndColumnsGoWithTheVertices) {
  Snapshot points = lattice_ball(6);
  std::vector<std::int64_t> id(points.size());
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = static_cast<std::int64_t>(i);
  points.columns = {{"place", "m", 3, points.points}, {"id", "", 1, id}};
  const SurfaceMesh all = surface_of(points, 0), mesh = surface_of(points, 0.8);
  ASSERT_EQ(mesh.normals.size(), mesh.points.size());
  ASSERT_EQ(mesh.columns.size(), 2u);
  const auto& place = std::get<std::vector<float>>(mesh.columns[0].values);
  ASSERT_EQ(place.size(), mesh.points.size());
  ASSERT_EQ(std::get<std::vector<std::int64_t>>(mesh.columns[1].values).size(), mesh.vertex_count());
  const auto vector_of = [](const std::vector<float>& from, std::size_t v) {
    return Vec3d{from[3 * v], from[3 * v + 1], from[3 * v + 2]};
  };
  std::size_t same = 0;  // vertices stay in their order
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v, ++same) {
    const Vec3d x = vector_of(mesh.points, v);
    while (same < all.vertex_count() && !(vector_of(all.points, same) == x)) ++same;
    ASSERT_LT(same, all.vertex_count());
    EXPECT_EQ(vector_of(mesh.normals, v), vector_of(all.normals, same));
    EXPECT_NEAR(length(vector_of(mesh.normals, v)), 1, 1e-5);
    EXPECT_LT(length(vector_of(place, v) - x), 2.2 * spacing);
  }
}

}  // namespace
}  // namespace sessile
