#include "sessile/scene/solid_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "unit/scene_files.h"

namespace sessile::test::of_solid_mesh {
namespace {

constexpr double pi = std::numbers::pi;

SolidMesh only(const SolidShape& shape, const Placement& placement = {}) {
  Scene scene;
  Solid& solid = scene.solids.emplace_back();
  solid.shape = shape;
  solid.placement = placement;
  const auto meshes = solid_meshes(scene);
  EXPECT_EQ(meshes.size(), 1u);
  return meshes.front();
}

/// Whether each edge is run through once in either direction: closed, and all triangles facing the same way.
bool even(const TriangleMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!edges.insert({t[k], t[(k + 1) % 3]}).second) return false;
    }
  }
  for (const auto& [a, b] : edges) {
    if (!edges.contains({b, a})) return false;
  }
  return true;
}

TEST(SolidMeshes, OfABoxIsTheBox) {
  const TriangleMesh mesh = only(Box{{1, 2, 3}}).mesh;
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_DOUBLE_EQ(mesh.area(), 22);
  EXPECT_DOUBLE_EQ(mesh.volume(), 6);
  EXPECT_TRUE(even(mesh));
}

TEST(SolidMeshes, OfAContainerLooksInwards) {
  const TriangleMesh mesh = only(Container{{1, 2, 3}}).mesh;
  EXPECT_DOUBLE_EQ(mesh.volume(), -6);
  EXPECT_TRUE(even(mesh));
}

TEST(SolidMeshes, OfAPlateIsOneSheetThatLooksUp) {
  const TriangleMesh mesh = only(Plate{4, 3}).mesh;
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_DOUBLE_EQ(mesh.area(), 12);
  for (const auto& t : mesh.triangles) {
    EXPECT_GT(cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]).z, 0);
  }
}

TEST(SolidMeshes, OfASphereIsRound) {
  const TriangleMesh mesh = only(Sphere{2}).mesh;
  EXPECT_TRUE(even(mesh));
  EXPECT_TRUE(mesh.closed());
  for (const Vec3d& v : mesh.vertices) EXPECT_NEAR(length(v), 2, 1e-12);
  EXPECT_LT(mesh.volume(), 4 * pi / 3 * 8);
  EXPECT_GT(mesh.volume(), 0.995 * 4 * pi / 3 * 8);
  EXPECT_NEAR(mesh.area(), 4 * pi * 4, 0.005 * 4 * pi * 4);
}

TEST(SolidMeshes, OfACylinderHasItsEnds) {
  const TriangleMesh mesh = only(Cylinder{0.5, 3}).mesh;
  EXPECT_TRUE(even(mesh));
  EXPECT_NEAR(mesh.volume(), pi * 0.25 * 3, 0.002 * pi * 0.25 * 3);
  EXPECT_NEAR(mesh.area(), 2 * pi * 0.5 * 3.5, 0.002 * 2 * pi * 0.5 * 3.5);
  EXPECT_DOUBLE_EQ(mesh.lower().z, -1.5);
  EXPECT_DOUBLE_EQ(mesh.upper().z, 1.5);
}

TEST(SolidMeshes, StandWhereTheSolidsDo) {
  const TriangleMesh mesh = only(Box{{2, 4, 6}}, {{10, 20, 30}, {0, 0, 1}, 90}).mesh;
  EXPECT_EQ(mesh.lower(), (Vec3d{8, 19, 27}));
  EXPECT_EQ(mesh.upper(), (Vec3d{12, 21, 33}));
  EXPECT_DOUBLE_EQ(mesh.volume(), 48);
}

TEST(SolidMeshes, HaveTheLabelsOfTheStats) {
  Scene scene;
  scene.solids.resize(3);
  scene.solids[1].label = "tablet";
  for (Solid& solid : scene.solids) solid.shape = Sphere{1};
  const auto meshes = solid_meshes(scene);
  ASSERT_EQ(meshes.size(), 3u);
  EXPECT_EQ(meshes[0].label, "solid0");
  EXPECT_EQ(meshes[1].label, "tablet");
  EXPECT_EQ(meshes[2].label, "solid2");
  EXPECT_TRUE(solid_meshes(Scene{}).empty());
}

class SolidMeshFiles : public SceneFiles {};

TEST_F(SolidMeshFiles, ComeFromTheFile) {
  const auto file = write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const TriangleMesh mesh = only(Mesh{file.string(), 3}, {{5, 0, 0}, {0, 0, 1}, 0}).mesh;
  EXPECT_NEAR(mesh.volume(), 27.0 / 6, 1e-12);
  EXPECT_EQ(mesh.lower(), (Vec3d{5, 0, 0}));
  EXPECT_THROW(only(Mesh{(folder_ / "none.obj").string(), 1}), FileError);
}

}  // namespace
}  // namespace sessile::test::of_solid_mesh
