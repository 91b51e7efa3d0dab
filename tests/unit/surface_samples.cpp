#include "unit/surface_samples.h"

namespace sessile::test {

SurfaceMesh tetrahedron_with_columns(double time) {
  SurfaceMesh mesh;
  mesh.time = time;
  mesh.step = 42;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1.0F / 3};
  mesh.normals = {-1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  mesh.triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
  mesh.columns.push_back({"id", "", 1, std::vector<std::int64_t>{5, 6, 7, -8}});
  mesh.columns.push_back({"velocity", "m/s", 3, std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 0.1F}});
  mesh.columns.push_back({"density", "kg/m^3", 1, std::vector<float>{1000, 1001, 999.5F, 1e-20F}});
  mesh.columns.push_back({"normal", "", 3, std::vector<float>(12, 0.5F)});
  return mesh;
}

}  // namespace sessile::test
