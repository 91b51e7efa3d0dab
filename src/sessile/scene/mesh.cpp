#include "sessile/scene/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <tuple>

#include "sessile/core/error.h"
#include "sessile/scene/input_file.h"
#include "sessile/scene/mesh_files.h"

namespace sessile {

namespace {

constexpr double farthest_vertex = 1e12;  // [m] beyond any scene
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;

std::string bytes_of(const std::string& file) {
  const auto cannot = [&](const std::string& why) { return FileError(file + ": cannot be read: " + why); };
  try {
    return read_input(file, largest_file);
  } catch (const FileError& fault) {
    throw cannot(fault.what());
  }
}

TriangleSoup parse(const std::string& file) {
  const std::string bytes = bytes_of(file);
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  try {
    if (extension == ".obj") return parse_obj(bytes);
    if (extension == ".stl") return parse_stl(bytes);
    if (extension == ".ply") return parse_ply(bytes);
  } catch (const FileError& fault) {
    throw FileError(file + ": " + fault.what());
  }
  throw FileError(file + ": is no .obj, .stl or .ply file");
}

}  // namespace

TriangleMesh make_mesh(const std::vector<Vec3d>& corners, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> order(corners.size()), number(corners.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) { return std::tie(corners[i].x, corners[i].y, corners[i].z); };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || key(order[k]) != key(order[k - 1])) mesh.vertices.push_back(corners[order[k]]);
    number[order[k]] = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : triangles) {
    const std::array<std::uint32_t, 3> joined{number[t[0]], number[t[1]], number[t[2]]};
    if (joined[0] == joined[1] || joined[1] == joined[2] || joined[2] == joined[0]) continue;
    mesh.triangles.push_back(joined);
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::minmax({joined[k], joined[(k + 1) % 3]}));
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end] == edges[begin]) ++end;
    mesh.open_edges += (end - begin) % 2;
  }
  return mesh;
}

TriangleMesh load_mesh(const Mesh& mesh) {
  TriangleSoup soup = parse(mesh.file);
  for (std::size_t i = 0; i < soup.corners.size(); ++i) {
    Vec3d& p = soup.corners[i];
    // Adding 0 makes -0 the same place as 0.
    p = {p.x * mesh.scale + 0.0, p.y * mesh.scale + 0.0, p.z * mesh.scale + 0.0};
    if (std::isfinite(p.x + p.y + p.z) && std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < farthest_vertex)
      continue;
    throw SceneError(
        fmt::format("{}: corner {} is not finite or farther away than {} m", mesh.file, i + 1, farthest_vertex));
  }
  TriangleMesh result = make_mesh(soup.corners, soup.triangles);
  if (result.triangles.empty() || !(result.area() > 0)) throw SceneError(mesh.file + ": holds no triangles");
  return result;
}

double TriangleMesh::area() const {
  double twice = 0;
  for (const auto& t : triangles) {
    twice += length(cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]));
  }
  return twice / 2;
}

double TriangleMesh::volume() const {
  double six = 0;
  // Taken about a vertex, a small mesh far from the origin loses no digits.
  const Vec3d origin = vertices.empty() ? Vec3d{} : vertices.front();
  for (const auto& t : triangles) {
    six += dot(vertices[t[0]] - origin, cross(vertices[t[1]] - origin, vertices[t[2]] - origin));
  }
  return six / 6;
}

Vec3d TriangleMesh::lower() const {
  Vec3d low = vertices.empty() ? Vec3d{} : vertices.front();
  for (const auto& v : vertices) low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
  return low;
}

Vec3d TriangleMesh::upper() const {
  Vec3d high = vertices.empty() ? Vec3d{} : vertices.front();
  for (const auto& v : vertices) high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  return high;
}

}  // namespace sessile
