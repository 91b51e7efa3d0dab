#include <algorithm>
#include <cmath>

#include "fuzz/targets.h"
#include "sessile/scene/mesh.h"
#include "sessile/scene/mesh_files.h"
#include "sessile/scene/mesh_sampling.h"
#include "sessile/scene/mesh_space.h"

namespace sessile::fuzz {
namespace {

/// As a solid of two layers, at a spacing that makes about a hundred samples.
void fill_with_samples(const TriangleMesh& mesh) {
  const double spacing = std::sqrt(mesh.area() / 50);
  if (!(spacing > 0) || !(estimate_mesh(mesh, spacing) < 1e4)) return;
  const MeshSpace space(mesh);
  static_cast<void>(space.contains(0.5 * (mesh.lower() + mesh.upper())));
  static_cast<void>(sample_mesh(mesh, spacing, mesh.closed() ? 2 : 1, "the mesh"));
}

void use(const TriangleSoup& soup) {
  for (const auto& triangle : soup.triangles) {
    for (const auto corner : triangle) must(corner < soup.corners.size(), "a triangle of a corner that there is not");
  }
  for (const Vec3d& p : soup.corners) {
    // load_mesh() refuses it
    if (!std::isfinite(p.x + p.y + p.z) || std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) >= 1e12) return;
  }
  const TriangleMesh mesh = make_mesh(soup.corners, soup.triangles);
  must(mesh.vertices.size() <= soup.corners.size(), "joining made vertices");
  must(mesh.triangles.empty() || !mesh.vertices.empty(), "triangles without vertices");
  if (!mesh.triangles.empty() && mesh.area() > 0) fill_with_samples(mesh);
}

}  // namespace

void read_mesh_obj(std::string_view bytes) { use(parse_obj(bytes)); }
void read_mesh_stl(std::string_view bytes) { use(parse_stl(bytes)); }
void read_mesh_ply(std::string_view bytes) { use(parse_ply(bytes)); }

}  // namespace sessile::fuzz
