#include "sessile/scene/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "sessile/scene/mesh_sampling.h"
#include "sessile/scene/mesh_space.h"
#include "sessile/scene/sampling.h"
#include "unit/scene_files.h"

namespace sessile::test {
namespace {

constexpr double pi = std::numbers::pi;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const std::vector<Vec3d> cube_corners{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                      {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
const Triangles cube_triangles{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                               {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

/// A torus of n x 2n quads: it has a hole, concave places and, for a ray, up to four passes.
TriangleMesh torus(double big, double small, std::uint32_t n) {
  std::vector<Vec3d> corners;
  Triangles triangles;
  for (std::uint32_t i = 0; i < 2 * n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const double u = pi * i / n, v = 2 * pi * j / n;
      corners.push_back(
          {(big + small * std::cos(v)) * std::cos(u), (big + small * std::cos(v)) * std::sin(u), small * std::sin(v)});
      const std::uint32_t i1 = (i + 1) % (2 * n), j1 = (j + 1) % n;
      triangles.push_back({i * n + j, i1 * n + j, i1 * n + j1});
      triangles.push_back({i * n + j, i1 * n + j1, i * n + j1});
    }
  }
  return make_mesh(corners, triangles);
}

std::string cube_obj() {
  std::string text = "mtllib /etc/hostname\no cube\n";
  for (const auto& c : cube_corners)
    text += "v " + std::to_string(c.x) + " " + std::to_string(c.y) + " " + std::to_string(c.z) + "\n";
  for (const auto& t : cube_triangles) {
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
  }
  return text;
}

std::string cube_ply() {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& c : cube_corners)
    text += std::to_string(c.x) + " " + std::to_string(c.y) + " " + std::to_string(c.z) + "\n";
  for (const auto& t : cube_triangles) {
    text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  }
  return text;
}

std::string cube_stl() {
  std::string text(80, ' ');
  const auto put = [&](auto value) { text.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(static_cast<std::uint32_t>(cube_triangles.size()));
  for (const auto& t : cube_triangles) {
    for (int k = 0; k < 3; ++k) put(0.0F);
    for (const auto v : t) {
      put(static_cast<float>(cube_corners[v].x));
      put(static_cast<float>(cube_corners[v].y));
      put(static_cast<float>(cube_corners[v].z));
    }
    put(std::uint16_t{0});
  }
  return text;
}

class MeshFiles : public SceneFiles {
 protected:
  std::string message_of(const std::string& name, const std::string& text) const {
    try {
      load_mesh({write(name, text).string(), 1});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(MeshFiles, ThreeFormats) {
  for (const auto& [name, text] : std::map<std::string, std::string>{
           {"c.obj", cube_obj()}, {"c.ply", cube_ply()}, {"c.stl", cube_stl()}, {"C.OBJ", cube_obj()}}) {
    const auto mesh = load_mesh({write(name, text).string(), 0.5});
    EXPECT_EQ(mesh.vertices.size(), 8U) << name;
    EXPECT_EQ(mesh.triangles.size(), 12U) << name;
    EXPECT_TRUE(mesh.closed()) << name;
    EXPECT_DOUBLE_EQ(mesh.volume(), 1) << name;
    EXPECT_DOUBLE_EQ(mesh.area(), 6) << name;
  }
}

TEST_F(MeshFiles, FaultsAreSentences) {
  const auto ends = [&](const std::string& name, const std::string& text, const std::string& end) {
    EXPECT_EQ(message_of(name, text), (folder_ / name).string() + ": " + end);
  };
  ends("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "holds no triangles");
  ends("b.obj", "", "holds no triangles");
  ends("f.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "a face names corner 9 of 3");
  ends("i.obj", "v 0 0\n", "line 1: expected three numbers");
  ends("j.obj", "v 0 0 0\nf 1 x 1\n", "line 2: expected the number of a corner");
  ends("g.stl", cube_stl().substr(0, 200), "is no STL file, or its end is missing");
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  ends("s.stl", "solid cut\n" + facet + "facet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
       "its end is missing: no endsolid");
  EXPECT_EQ(message_of("t.stl", "solid whole\n" + facet + "endsolid whole\n"), "");
  ends("h.ply", cube_ply().substr(0, 100), "has no complete PLY header");
  ends("k.ply", cube_ply().substr(0, 300), "its numbers end too early or are none");
  EXPECT_TRUE(has(message_of("c.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), "c.obj: holds no triangles"));
  EXPECT_TRUE(has(message_of("d.obj", "v 0 0 0\nv 1 0 0\nv 0 1e30 0\nf 1 2 3\n"),
                  "d.obj: corner 3 is not finite or farther away than 1000000000000 m"));
  EXPECT_NE(message_of("e.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n"), "");
  EXPECT_THROW(load_mesh({(folder_ / "none.obj").string(), 1}), FileError);
}

TEST_F(MeshFiles, BrokenFilesDoNotCrash) {
  std::mt19937 random(7);
  const std::array<std::pair<const char*, std::string>, 3> sound{
      {{"m.obj", cube_obj()}, {"m.ply", cube_ply()}, {"m.stl", cube_stl()}}};
  for (int round = 0; round < 900; ++round) {
    auto [name, text] = sound[static_cast<std::size_t>(round) % 3];
    for (int k = 0; k < 1 + round % 5; ++k) text[random() % text.size()] = static_cast<char>(random());
    if (round % 4 == 0) text.resize(random() % text.size());
    message_of(name, text);
  }
}

TEST_F(MeshFiles, LiquidNeedsAClosedMesh) {
  Body body;
  const std::string obj = cube_obj();
  body.shape = Mesh{write("c.obj", obj).string(), 1};
  EXPECT_EQ(fill(body, 0.1).size(), 8000U);
  EXPECT_NEAR(estimate_fill(body, 0.1), 8000, 1e-6);
  const auto open = write("o.obj", obj.substr(0, obj.rfind("f ")));
  body.shape = Mesh{open.string(), 1};
  try {
    fill(body, 0.1);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_EQ(error.what(),
              open.string() + ": is not closed (3 edges have a triangle on one side only), so liquid cannot fill it");
  }
}

TEST_F(MeshFiles, AreSolids) {
  Solid solid;
  solid.shape = Mesh{write("c.stl", cube_stl()).string(), 1};
  solid.placement.position = {5, 0, 0};
  const SolidGeometry geometry(solid);
  EXPECT_TRUE(geometry.contains({5.9, 0.1, 0.2}));
  EXPECT_FALSE(geometry.contains({6.1, 0.1, 0.2}));
  EXPECT_TRUE(geometry.crossed({3, 0, 0}, {8, 0, 0}));
  EXPECT_FALSE(geometry.crossed({5, 0, 0}, {8, 0, 0}));
  EXPECT_EQ(geometry.lower(), (Vec3d{4, -1, -1}));
  const auto samples = sample_surface(solid, 0.1);
  EXPECT_NEAR(static_cast<double>(samples.size()), 2700, 400);
  for (const auto& p : samples) {
    EXPECT_NEAR(std::max({std::abs(p.x - 5), std::abs(p.y), std::abs(p.z)}), 1, 1e-12);
  }
}

// The signed volumes of two cubes that face opposite ways cancel, and filling them does not.
TEST(RoughVolume, DoesNotCancel) {
  for (const double apart : {12.0, 1e4}) {
    std::vector<Vec3d> places;
    Triangles triangles;
    for (const bool flipped : {false, true}) {
      const auto first = static_cast<std::uint32_t>(places.size());
      for (const Vec3d& corner : cube_corners) places.push_back(5 * corner + Vec3d{flipped ? apart : 0, 0, 0});
      for (auto t : cube_triangles) {
        if (flipped) std::swap(t[1], t[2]);
        triangles.push_back({first + t[0], first + t[1], first + t[2]});
      }
    }
    const TriangleMesh mesh = make_mesh(places, triangles);
    EXPECT_NEAR(mesh.volume(), 0, 1e-6);
    EXPECT_NEAR(MeshSpace(mesh).rough_volume(), 2000, 100) << apart;
  }
}

TEST(MeshSpace, KnowsTheInsideOfATorus) {
  const auto mesh = torus(1, 0.4, 64);
  EXPECT_TRUE(mesh.closed());
  EXPECT_NEAR(std::abs(mesh.volume()), 2 * pi * pi * 0.16, 0.02);
  const MeshSpace space(mesh);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  int inside = 0, checked = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d p{place(random), place(random), place(random) / 3};
    const double distance = std::hypot(std::hypot(p.x, p.y) - 1, p.z) - 0.4;
    if (std::abs(distance) < 5e-3) continue;  // the triangles cut corners
    ++checked;
    inside += space.contains(p) ? 1 : 0;
    ASSERT_EQ(space.contains(p), distance < 0);
  }
  EXPECT_GT(inside, checked / 10);
}

TEST(MeshSpace, HasNoLeaks) {
  // Ways from the inside of a cube to the outside, many of them through its edges and corners exactly.
  const MeshSpace space(make_mesh(cube_corners, cube_triangles));
  for (int i = -4; i <= 4; ++i) {
    for (int j = -4; j <= 4; ++j) {
      for (int k = -4; k <= 4; ++k) {
        const Vec3d p = 0.25 * Vec3d{double(i), double(j), double(k)};
        const bool inside = std::max({std::abs(i), std::abs(j), std::abs(k)}) < 4;
        EXPECT_TRUE(!inside || space.contains(p));
        if (std::max({std::abs(i), std::abs(j), std::abs(k)}) == 4) {
          EXPECT_TRUE(space.crossed(0.5 * p, 2.0 * p)) << i << j << k;
          EXPECT_FALSE(space.contains(1.01 * p));
        }
      }
    }
  }
}

TEST(MeshSpace, IsTheSameAtEveryScale) {
  for (const double s : {1e-6, 1e4}) {
    const auto mesh = torus(s, 0.4 * s, 16);
    const MeshSpace space(mesh);
    EXPECT_TRUE(space.contains({s, 0, 0}));
    EXPECT_FALSE(space.contains({0, 0, 0}));
    EXPECT_TRUE(space.crossed({0, 0, 0}, {s, 0, 0}));
    EXPECT_EQ(sample_mesh(mesh, 0.1 * s, 2, "").size() / 100, sample_mesh(torus(1, 0.4, 16), 0.1, 2, "").size() / 100);
  }
}

TEST(MeshSampling, IsEvenWhateverTheTriangles) {
  for (const std::uint32_t n : {8U, 32U, 128U}) {
    const auto mesh = torus(1, 0.4, n);
    const auto samples = sample_mesh(mesh, 0.1, 1, "");
    EXPECT_NEAR(static_cast<double>(samples.size()) * 0.01, mesh.area(), 0.25 * mesh.area()) << n;
    EXPECT_EQ(samples, sample_mesh(mesh, 0.1, 1, ""));
    for (std::size_t i = 0; i < samples.size(); ++i) {
      double nearest = 1;
      for (std::size_t j = 0; j < samples.size(); ++j) {
        if (i != j) nearest = std::min(nearest, length(samples[i] - samples[j]));
      }
      ASSERT_GE(nearest, 0.086 * (1 - 1e-12));
      ASSERT_LT(nearest, 0.15);
    }
  }
}

TEST(MeshSampling, FurtherLayersLieInside) {
  auto mesh = torus(1, 0.4, 64);
  const auto one = sample_mesh(mesh, 0.1, 1, ""), two = sample_mesh(mesh, 0.1, 2, "");
  EXPECT_GT(two.size(), one.size() * 3 / 2);
  for (std::size_t i = one.size(); i < two.size(); ++i) {
    ASSERT_NEAR(std::hypot(std::hypot(two[i].x, two[i].y) - 1, two[i].z), 0.3, 0.01);
  }
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);  // the other way round, the same layers
  EXPECT_NEAR(static_cast<double>(sample_mesh(mesh, 0.1, 2, "").size()), static_cast<double>(two.size()), 60);
  mesh.triangles.pop_back();
  mesh.open_edges = 3;
  EXPECT_THROW(sample_mesh(mesh, 0.1, 2, "solid (mesh)"), SceneError);
}

}  // namespace
}  // namespace sessile::test
