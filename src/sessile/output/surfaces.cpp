#include "sessile/output/surfaces.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "sessile/output/ply_rows.h"
#include "sessile/output/vtk_xml.h"

namespace sessile {
namespace {

constexpr auto all_surface_formats = std::to_array<SurfaceFormat>({
    {"ply", "binary PLY: Blender, MeshLab and most others", encode_surface_ply},
    {"obj", "Wavefront OBJ: shape and normals alone", encode_surface_obj},
    {"vtp", "VTK PolyData for ParaView, with a collection surface.pvd that carries the physical time",
     encode_surface_vtp},
    {"vdb", "OpenVDB: a level set named surface, in m", nullptr},
    {"usda", "USD: one file for all frames, with solids and velocities", nullptr},
});

bool has_normals(const SurfaceMesh& mesh) { return mesh.normals.size() == mesh.points.size(); }

}  // namespace

std::span<const SurfaceFormat> surface_formats() { return all_surface_formats; }

const SurfaceFormat* find_surface_format(std::string_view name) {
  const auto found = std::find_if(all_surface_formats.begin(), all_surface_formats.end(),
                                  [&](const auto& f) { return f.name == name; });
  return found == all_surface_formats.end() ? nullptr : &*found;
}

std::string surface_file_name(std::int64_t number, std::string_view format) {
  return fmt::format("surface_{:06}.{}", number, format);
}

std::string encode_surface_ply(const SurfaceMesh& mesh) {
  PlyRows rows(mesh.vertex_count());
  rows.vectors(mesh.points, "x", "y", "z");
  if (has_normals(mesh)) rows.vectors(mesh.normals, "nx", "ny", "nz");
  for (const Column& column : mesh.columns) rows.column(column, false);
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment Sessile surface, time {} s, step {}\nelement vertex {}\n{}"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.time, mesh.step, mesh.vertex_count(), rows.header(), mesh.triangle_count());
  rows.append_to(bytes);
  constexpr std::size_t face_bytes = 1 + 3 * sizeof(std::uint32_t);
  bytes.reserve(bytes.size() + face_bytes * mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    bytes += '\3';
    bytes.append(reinterpret_cast<const char*>(&mesh.triangles[3 * t]), face_bytes - 1);
  }
  return bytes;
}

std::string encode_surface_obj(const SurfaceMesh& mesh) {
  std::string text = fmt::format("# Sessile surface, time {} s, step {}\n", mesh.time, mesh.step);
  const auto to = std::back_inserter(text);
  const auto lines = [&](std::string_view key, const std::vector<float>& v) {
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
      fmt::format_to(to, FMT_COMPILE("{} {} {} {}\n"), key, v[i], v[i + 1], v[i + 2]);
    }
  };
  lines("v", mesh.points);
  lines("vn", mesh.normals);
  const bool normals = has_normals(mesh);
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const std::array<std::uint32_t, 3> n{mesh.triangles[i] + 1, mesh.triangles[i + 1] + 1, mesh.triangles[i + 2] + 1};
    if (normals) {
      fmt::format_to(to, FMT_COMPILE("f {0}//{0} {1}//{1} {2}//{2}\n"), n[0], n[1], n[2]);
    } else {
      fmt::format_to(to, FMT_COMPILE("f {} {} {}\n"), n[0], n[1], n[2]);
    }
  }
  return text;
}

std::string encode_surface_vtp(const SurfaceMesh& mesh) {
  std::vector<std::int64_t> corners(mesh.triangles.begin(), mesh.triangles.end());
  std::vector<std::int64_t> ends(mesh.triangle_count());
  for (std::size_t t = 0; t < ends.size(); ++t) ends[t] = static_cast<std::int64_t>(3 * (t + 1));

  VtkDocument document(mesh.time, mesh.step);
  document.text(fmt::format(
      R"(<Piece NumberOfPoints="{}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{}">
<PointData{}>
)",
      mesh.vertex_count(), mesh.triangle_count(), has_normals(mesh) ? " Normals=\"Normals\"" : ""));
  if (has_normals(mesh)) document.array("Normals", "", 3, mesh.normals);
  for (const Column& column : mesh.columns) document.array(column);
  document.text("</PointData>\n<Points>\n");
  document.array("Points", "m", 3, mesh.points);
  document.text("</Points>\n<Polys>\n");
  document.array("connectivity", "", 1, corners);
  document.array("offsets", "", 1, ends);
  document.text("</Polys>\n</Piece>\n");
  return std::move(document).whole();
}

SurfaceMesh as_surface(const TriangleMesh& mesh) {
  SurfaceMesh surface;
  for (const Vec3d& v : mesh.vertices) {
    for (const double coordinate : {v.x, v.y, v.z}) surface.points.push_back(static_cast<float>(coordinate));
  }
  for (const auto& t : mesh.triangles) surface.triangles.insert(surface.triangles.end(), t.begin(), t.end());
  return surface;
}

}  // namespace sessile
