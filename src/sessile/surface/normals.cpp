#include "sessile/surface/normals.h"

#include <cstddef>

#include "sessile/core/parallel.h"
#include "sessile/core/vec.h"

namespace sessile {

std::vector<float> vertex_normals(const SurfaceMesh& mesh) {
  std::vector<Vec3d> sums(mesh.vertex_count());
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const auto corner = [&](std::size_t k) {
      const float* x = &mesh.points[3 * std::size_t{mesh.triangles[t + k]}];
      return Vec3d{x[0], x[1], x[2]};
    };
    const Vec3d a = corner(0), twice_area = cross(corner(1) - a, corner(2) - a);
    for (std::size_t k = 0; k < 3; ++k) sums[mesh.triangles[t + k]] += twice_area;
  }
  std::vector<float> normals(mesh.points.size());
  for_each(sums.size(), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    const double norm = length(sums[k]);
    const Vec3d unit = norm > 0 ? 1 / norm * sums[k] : Vec3d{0, 0, 1};
    normals[3 * k] = static_cast<float>(unit.x);
    normals[3 * k + 1] = static_cast<float>(unit.y);
    normals[3 * k + 2] = static_cast<float>(unit.z);
  });
  return normals;
}

}  // namespace sessile
