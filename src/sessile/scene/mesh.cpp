#include "sessile/scene/mesh.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>
#include <numeric>
#include <string_view>
#include <system_error>
#include <tuple>

#include "sessile/core/error.h"

namespace sessile {

namespace {

constexpr double farthest_vertex = 1e12;  // [m] beyond any scene
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;

/// Opens the mesh itself and nothing that it names: a model from elsewhere shall not reach other files.
class OneFile : public Assimp::DefaultIOSystem {
 public:
  explicit OneFile(std::string file) : file_(std::move(file)) {}
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    return name == file_ ? DefaultIOSystem::Open(name, mode) : nullptr;
  }
  bool Exists(const char* name) const override { return name == file_ && DefaultIOSystem::Exists(name); }

 private:
  std::string file_;
};

/// Takes out every importer but those of the three formats, which otherwise judge a file by its content.
void keep_three_formats(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* const each = importer.GetImporter(i);
    const std::string_view extensions = each->GetInfo()->mFileExtensions;
    if (extensions == "obj" || extensions == "stl" || extensions == "ply") continue;
    importer.UnregisterLoader(each);
    const std::unique_ptr<Assimp::BaseImporter> ours(each);
  }
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
  std::error_code error;
  const auto size = std::filesystem::file_size(mesh.file, error);
  if (error) throw FileError(mesh.file + ": cannot be read: " + error.message());
  if (size > largest_file) throw FileError(fmt::format("{}: is larger than {} MiB", mesh.file, largest_file >> 20));

  Assimp::Importer importer;
  keep_three_formats(importer);
  importer.SetIOHandler(new OneFile(mesh.file));  // the importer owns it
  const aiScene* scene = nullptr;
  try {
    scene = importer.ReadFile(mesh.file, aiProcess_Triangulate);
  } catch (const std::exception& exception) {
    throw FileError(mesh.file + ": cannot be read: " + exception.what());
  }
  if (scene == nullptr) throw FileError(mesh.file + ": cannot be read: " + importer.GetErrorString());

  std::vector<Vec3d> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    if (part.mVertices == nullptr || part.mFaces == nullptr) continue;
    const auto base = static_cast<std::uint32_t>(corners.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D& p = part.mVertices[v];
      // Adding 0 makes -0 the same place as 0.
      const Vec3d corner{p.x * mesh.scale + 0.0, p.y * mesh.scale + 0.0, p.z * mesh.scale + 0.0};
      if (!(std::max({std::abs(corner.x), std::abs(corner.y), std::abs(corner.z)}) < farthest_vertex)) {
        throw SceneError(
            fmt::format("{}: vertex {} is not finite or farther away than {} m", mesh.file, v, farthest_vertex));
      }
      corners.push_back(corner);
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;
      const auto past = [&](unsigned index) { return index >= part.mNumVertices; };
      if (std::any_of(face.mIndices, face.mIndices + 3, past)) {
        throw SceneError(fmt::format("{}: triangle {} names a vertex that is not there", mesh.file, f));
      }
      triangles.push_back({base + face.mIndices[0], base + face.mIndices[1], base + face.mIndices[2]});
    }
  }
  TriangleMesh result = make_mesh(corners, triangles);
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
