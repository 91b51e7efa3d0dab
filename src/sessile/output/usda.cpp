#include "sessile/output/usda.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>
#include <utility>

#include "sessile/core/error.h"
#include "sessile/output/surfaces.h"

namespace sessile {
namespace {

/// A word that USD takes as a name: letters, digits and '_', no digit in front.
std::string identifier(std::string_view word) {
  std::string name;
  for (const char c : word) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0 ? "_" + name : name;
}

template <class T>
std::string list_of(const std::vector<T>& values) {
  std::string text = "[";
  for (const T value : values) {
    fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}{}"), text.size() > 1 ? ", " : "", value);
  }
  return text + ']';
}

std::string vectors_of(const std::vector<float>& v) {
  std::string text = "[";
  for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
    fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}({}, {}, {})"), i > 0 ? ", " : "", v[i], v[i + 1],
                   v[i + 2]);
  }
  return text + ']';
}

/// As many threes as there are triangles.
std::string counts_of(const SurfaceMesh& mesh) {
  std::string text = "[";
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) text += i > 0 ? ", 3" : "3";
  return text + ']';
}

std::string extent_of(const SurfaceMesh& mesh) {
  if (mesh.points.empty()) return "[]";
  std::vector<float> corners(mesh.points.begin(), mesh.points.begin() + 3);
  corners.insert(corners.end(), corners.begin(), corners.begin() + 3);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    corners[i % 3] = std::min(corners[i % 3], mesh.points[i]);
    corners[3 + i % 3] = std::max(corners[3 + i % 3], mesh.points[i]);
  }
  return vectors_of(corners);
}

constexpr std::string_view mesh_traits =
    "        uniform token subdivisionScheme = \"none\"\n        uniform token orientation = \"rightHanded\"\n";

std::string solid_text(const std::string& name, const SurfaceMesh& mesh) {
  return fmt::format(
      "\n    def Mesh \"{}\"\n    {{\n{}        uniform bool doubleSided = 1\n        float3[] extent = {}\n"
      "        point3f[] points = {}\n        int[] faceVertexCounts = {}\n        int[] faceVertexIndices = {}\n    "
      "}}\n",
      name, mesh_traits, extent_of(mesh), vectors_of(mesh.points), counts_of(mesh), list_of(mesh.triangles));
}

/// Appends what a file holds.
void copy(const std::filesystem::path& from, LineFile& to) {
  std::ifstream in(from, std::ios::binary);
  std::vector<char> block(std::size_t{1} << 20);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    to.append({block.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (!in.eof()) throw FileError(fmt::format("cannot read {}: {}", from.string(), std::strerror(errno)));
}

}  // namespace

UsdaWriter::UsdaWriter(std::filesystem::path file, double frames_per_second)
    : file_(std::move(file)), rate_(frames_per_second) {}

UsdaWriter::~UsdaWriter() {
  std::error_code ignored;
  std::filesystem::remove(part_name(file_), ignored);
  for (const Attribute& each : attributes_) std::filesystem::remove(each.file, ignored);
}

void UsdaWriter::sample(std::string_view type_and_name, std::string_view brackets, const std::string& value) {
  auto found = std::find_if(attributes_.begin(), attributes_.end(),
                            [&](const Attribute& each) { return each.name == type_and_name; });
  if (found == attributes_.end()) {
    const auto part = file_.parent_path() / fmt::format("{}.{}", file_.filename().string(), attributes_.size());
    Attribute attribute{std::string(brackets), std::string(type_and_name), part_name(part), nullptr};
    attribute.samples = std::make_unique<LineFile>(attribute.file);
    attributes_.push_back(std::move(attribute));
    found = attributes_.end() - 1;
  }
  found->samples->append(fmt::format("            {}: {},\n", code_, value));
}

void UsdaWriter::column(const Column& column) {
  constexpr std::string_view of_vertices = "interpolation = \"vertex\"";
  const std::string name = identifier(column.name);
  const auto* const floats = std::get_if<std::vector<float>>(&column.values);
  if (floats == nullptr) {
    sample("int64[] primvars:" + name, of_vertices, list_of(std::get<std::vector<std::int64_t>>(column.values)));
  } else if (column.components == 1) {
    sample("float[] primvars:" + name, of_vertices, list_of(*floats));
  } else if (column.name == "velocity") {
    sample("vector3f[] velocities", "", vectors_of(*floats));
  } else {
    sample("vector3f[] primvars:" + name, of_vertices, vectors_of(*floats));
  }
}

void UsdaWriter::add(const SurfaceMesh& mesh) {
  code_ = mesh.time * rate_;
  if (!std::exchange(any_, true)) first_code_ = code_;
  sample("float3[] extent", "", extent_of(mesh));
  sample("int[] faceVertexCounts", "", counts_of(mesh));
  sample("int[] faceVertexIndices", "", list_of(mesh.triangles));
  sample("point3f[] points", "", vectors_of(mesh.points));
  sample("normal3f[] normals", "interpolation = \"vertex\"", vectors_of(mesh.normals));
  for (const Column& each : mesh.columns) column(each);
}

void UsdaWriter::finish(const Vec3d& up, std::span<const SolidMesh> solids) {
  {
    LineFile out(part_name(file_));
    out.append(fmt::format(
        "#usda 1.0\n(\n    doc = \"A liquid's surface, by Sessile\"\n    defaultPrim = \"World\"\n    upAxis = \"{}\"\n"
        "    metersPerUnit = 1\n    timeCodesPerSecond = {}\n    framesPerSecond = {}\n    startTimeCode = {}\n"
        "    endTimeCode = {}\n)\n\ndef Xform \"World\"\n{{\n    def Mesh \"surface\"\n    {{\n{}",
        std::abs(up.y) > std::abs(up.z) ? "Y" : "Z", rate_, rate_, first_code_, code_, mesh_traits));
    for (const Attribute& each : attributes_) {
      // What stands in brackets belongs to the attribute, not to its samples.
      if (!each.declaration.empty()) {
        out.append(fmt::format("        {} (\n            {}\n        )\n", each.name, each.declaration));
      }
      out.append(fmt::format("        {}.timeSamples = {{\n", each.name));
      copy(each.file, out);
      out.append("        }\n");
    }
    out.append("    }\n");
    std::set<std::string> names{"surface"};
    for (const SolidMesh& solid : solids) {
      std::string name = identifier(solid.label);
      while (!names.insert(name).second) name += '_';
      out.append(solid_text(name, as_surface(solid.mesh)));
    }
    out.append("}\n");
  }
  finish_part(file_);
}

}  // namespace sessile
