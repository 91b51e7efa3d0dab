#include "sessile/surface/surface_mesh.h"

#include "sessile/core/parallel.h"
#include "sessile/core/vec.h"

namespace sessile {
namespace {

Vec3d corner(const SurfaceMesh& mesh, std::size_t triangle, std::size_t k) {
  const std::size_t vertex = mesh.triangles[3 * triangle + k];
  return {mesh.points[3 * vertex], mesh.points[3 * vertex + 1], mesh.points[3 * vertex + 2]};
}

}  // namespace

double surface_area(const SurfaceMesh& mesh) {
  return sum(mesh.triangle_count(), [&](int i) {
    const auto triangle = static_cast<std::size_t>(i);
    const Vec3d a = corner(mesh, triangle, 0);
    return 0.5 * length(cross(corner(mesh, triangle, 1) - a, corner(mesh, triangle, 2) - a));
  });
}

double enclosed_volume(const SurfaceMesh& mesh) {
  if (mesh.points.empty()) return 0;
  // Tetrahedra with a point of the mesh: those with a far origin would cancel.
  const Vec3d origin = corner(mesh, 0, 0);
  return sum(mesh.triangle_count(), [&](int i) {
    const auto triangle = static_cast<std::size_t>(i);
    const Vec3d a = corner(mesh, triangle, 0) - origin;
    return dot(a, cross(corner(mesh, triangle, 1) - origin, corner(mesh, triangle, 2) - origin)) / 6;
  });
}

}  // namespace sessile
