#include <cmath>

#include "fuzz/targets.h"
#include "sessile/scene/mesh.h"
#include "sessile/scene/mesh_files.h"

namespace sessile::fuzz {
namespace {

void use(const TriangleSoup& soup) {
  for (const auto& triangle : soup.triangles) {
    for (const auto corner : triangle) must(corner < soup.corners.size(), "a triangle of a corner that there is not");
  }
  for (const Vec3d& p : soup.corners) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return;  // load_mesh() refuses it
  }
  const TriangleMesh mesh = make_mesh(soup.corners, soup.triangles);
  must(mesh.vertices.size() <= soup.corners.size(), "joining made vertices");
  must(mesh.triangles.empty() || !mesh.vertices.empty(), "triangles without vertices");
}

}  // namespace

void read_mesh_obj(std::string_view bytes) { use(parse_obj(bytes)); }
void read_mesh_stl(std::string_view bytes) { use(parse_stl(bytes)); }
void read_mesh_ply(std::string_view bytes) { use(parse_ply(bytes)); }

}  // namespace sessile::fuzz
