#include "sessile/scene/solid_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "sessile/scene/frame.h"

namespace sessile {
namespace {

using std::numbers::pi;
constexpr std::uint32_t corners_around = 96;  // of a round shape, whose outline then bends by less than 4 degrees

using Triangle = std::array<std::uint32_t, 3>;

TriangleMesh cuboid(const Vec3d& size) {
  std::vector<Vec3d> corners;
  for (const unsigned k : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U}) {
    const auto side = [&](unsigned bit, double length) { return (k & bit) != 0 ? length / 2 : -length / 2; };
    corners.push_back({side(1, size.x), side(2, size.y), side(4, size.z)});
  }
  return make_mesh(corners, {{0, 2, 1},
                             {1, 2, 3},
                             {4, 5, 6},
                             {5, 7, 6},
                             {0, 1, 4},
                             {1, 5, 4},
                             {2, 6, 3},
                             {3, 6, 7},
                             {0, 4, 2},
                             {2, 4, 6},
                             {1, 3, 5},
                             {3, 7, 5}});
}

/// Rings of corners about the z axis, from below to above, closed by a corner at either end.
class Turned {
 public:
  explicit Turned(double lowest) : corners_{{0, 0, lowest}} {}

  void ring(double radius, double z) {
    for (std::uint32_t i = 0; i < corners_around; ++i) {
      const double angle = 2 * pi * i / corners_around;
      corners_.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
    ++rings_;
  }

  TriangleMesh closed(double highest) && {
    corners_.push_back({0, 0, highest});
    std::vector<Triangle> triangles;
    const auto top = static_cast<std::uint32_t>(corners_.size() - 1);
    for (std::uint32_t i = 0; i < corners_around; ++i) {
      triangles.push_back({0, at(0, i + 1), at(0, i)});
      for (std::uint32_t k = 0; k + 1 < rings_; ++k) {
        triangles.push_back({at(k, i), at(k, i + 1), at(k + 1, i + 1)});
        triangles.push_back({at(k, i), at(k + 1, i + 1), at(k + 1, i)});
      }
      triangles.push_back({top, at(rings_ - 1, i), at(rings_ - 1, i + 1)});
    }
    return make_mesh(corners_, triangles);
  }

 private:
  std::uint32_t at(std::uint32_t ring, std::uint32_t i) const { return 1 + ring * corners_around + i % corners_around; }

  std::vector<Vec3d> corners_;
  std::uint32_t rings_ = 0;
};

TriangleMesh triangles_of(const Box& box) { return cuboid(box.size); }

TriangleMesh triangles_of(const Container& container) {
  TriangleMesh mesh = cuboid(container.size);
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh triangles_of(const Plate& plate) {
  const double x = plate.width / 2, y = plate.depth / 2;
  return make_mesh({{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

TriangleMesh triangles_of(const Sphere& sphere) {
  constexpr std::uint32_t rings = corners_around / 2 - 1;
  Turned turned(-sphere.radius);
  for (std::uint32_t k = 1; k <= rings; ++k) {
    const double angle = pi * k / (rings + 1);
    turned.ring(sphere.radius * std::sin(angle), -sphere.radius * std::cos(angle));
  }
  return std::move(turned).closed(sphere.radius);
}

TriangleMesh triangles_of(const Cylinder& cylinder) {
  Turned turned(-cylinder.height / 2);
  turned.ring(cylinder.radius, -cylinder.height / 2);
  turned.ring(cylinder.radius, cylinder.height / 2);
  return std::move(turned).closed(cylinder.height / 2);
}

TriangleMesh triangles_of(const Mesh& file) { return load_mesh(file); }

}  // namespace

std::vector<SolidMesh> solid_meshes(const Scene& scene) {
  std::vector<SolidMesh> meshes;
  for (const Solid& solid : scene.solids) {
    const std::string label = solid.label.empty() ? "solid" + std::to_string(meshes.size()) : solid.label;
    TriangleMesh mesh = std::visit([](const auto& shape) { return triangles_of(shape); }, solid.shape);
    const Frame frame(solid.placement);
    for (Vec3d& vertex : mesh.vertices) vertex = frame.to_world(vertex);
    meshes.push_back({label, std::move(mesh)});
  }
  return meshes;
}

}  // namespace sessile
