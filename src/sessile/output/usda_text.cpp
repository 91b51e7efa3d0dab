#include "sessile/output/usda_text.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>

#include "sessile/output/surfaces.h"

namespace sessile::usda {
namespace {

template <class T>
std::string any_list_of(const std::vector<T>& values) {
  std::string text = "[";
  for (const T value : values) {
    fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}{}"), text.size() > 1 ? ", " : "", value);
  }
  return text + ']';
}

}  // namespace

std::string identifier(std::string_view word) {
  std::string name;
  for (const char c : word) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0 ? "_" + name : name;
}

std::string list_of(const std::vector<float>& values) { return any_list_of(values); }
std::string list_of(const std::vector<std::uint32_t>& values) { return any_list_of(values); }
std::string list_of(const std::vector<std::int64_t>& values) { return any_list_of(values); }

std::string vectors_of(const std::vector<float>& v) {
  std::string text = "[";
  for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
    fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}({}, {}, {})"), i > 0 ? ", " : "", v[i], v[i + 1],
                   v[i + 2]);
  }
  return text + ']';
}

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

std::string solid_text(const std::string& name, const SurfaceMesh& mesh) {
  return fmt::format(
      "\n    def Mesh \"{}\"\n    {{\n{}        uniform bool doubleSided = 1\n        float3[] extent = {}\n"
      "        point3f[] points = {}\n        int[] faceVertexCounts = {}\n        int[] faceVertexIndices = {}\n    "
      "}}\n",
      name, mesh_traits, extent_of(mesh), vectors_of(mesh.points), counts_of(mesh), list_of(mesh.triangles));
}

bool is_type_and_name(std::string_view text) {
  const auto is_word = [](std::string_view word, std::string_view more) {
    return !word.empty() && std::all_of(word.begin(), word.end(), [&](unsigned char c) {
      return std::isalnum(c) != 0 || more.find(static_cast<char>(c)) != std::string_view::npos;
    });
  };
  constexpr std::string_view of_many = "[] ";
  const auto cut = text.find(of_many);
  return cut != std::string_view::npos && is_word(text.substr(0, cut), "") &&
         is_word(text.substr(cut + of_many.size()), "_:");
}

std::optional<double> code_of(std::string_view line) {
  if (!line.starts_with(sample_indent)) return {};
  line.remove_prefix(sample_indent.size());
  double code = 0;
  const auto [rest, error] = std::from_chars(line.data(), line.data() + line.size(), code);
  if (error != std::errc{} || !std::isfinite(code)) return {};
  line.remove_prefix(static_cast<std::size_t>(rest - line.data()));
  return line.starts_with(": [") && line.ends_with("],") ? std::optional(code) : std::nullopt;
}

}  // namespace sessile::usda
