#include "sessile/surface/manifold.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace sessile {
namespace {

SurfaceMesh tetrahedron() {
  SurfaceMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  mesh.triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  return mesh;
}

TEST(SurfaceManifold, TetrahedronIsOne) {
  const SurfaceMesh mesh = tetrahedron();
  const MeshReport report = inspect(mesh);
  EXPECT_TRUE(report.closed_manifold());
  EXPECT_EQ(report.pieces, 1u);
  EXPECT_EQ(report.euler, 2);
  EXPECT_NEAR(enclosed_volume(mesh), 1. / 6, 1e-7);
  EXPECT_NEAR(surface_area(mesh), 1.5 + std::sqrt(3.) / 2, 1e-7);
}

TEST(SurfaceManifold, HoleFlipAndPinchAreSeen) {
  SurfaceMesh open = tetrahedron();
  open.triangles.resize(9);
  EXPECT_EQ(inspect(open).bad_edges, 3u);
  SurfaceMesh flipped = tetrahedron();
  std::swap(flipped.triangles[1], flipped.triangles[2]);
  EXPECT_GT(inspect(flipped).bad_edges, 0u);
  SurfaceMesh pinched = tetrahedron();  // two that share a corner
  pinched.points.insert(pinched.points.end(), {-1, 0, 0, 0, -1, 0, 0, 0, -1});
  pinched.triangles.insert(pinched.triangles.end(), {0, 4, 5, 0, 6, 4, 0, 5, 6, 4, 6, 5});
  EXPECT_EQ(inspect(pinched).bad_edges, 0u);
  EXPECT_EQ(inspect(pinched).bad_vertices, 1u);
}

}  // namespace
}  // namespace sessile
