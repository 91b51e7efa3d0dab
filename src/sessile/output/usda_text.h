#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sessile/surface/surface_mesh.h"

/// The words of USD's text format that a surface is written in, and what is read back of them.
namespace sessile::usda {

// What stands before a sample, the attribute that every frame has, and what every mesh says of itself.
inline constexpr std::string_view sample_indent = "            ", points_name = "point3f[] points";
inline constexpr std::string_view mesh_traits =
    "        uniform token subdivisionScheme = \"none\"\n        uniform token orientation = \"rightHanded\"\n";

/// A word that USD takes as a name: letters, digits and '_', no digit in front.
std::string identifier(std::string_view word);

std::string list_of(const std::vector<float>& values);
std::string list_of(const std::vector<std::uint32_t>& values);
std::string list_of(const std::vector<std::int64_t>& values);

/// Vectors (x, y, z), from three values each.
std::string vectors_of(const std::vector<float>& values);

/// As many threes as there are triangles.
std::string counts_of(const SurfaceMesh& mesh);

/// The least and the greatest corner.
std::string extent_of(const SurfaceMesh& mesh);

/// A mesh that does not change.
std::string solid_text(const std::string& name, const SurfaceMesh& mesh);

/// Whether a text may be the type and name of an attribute as it is written: `point3f[] points`.
bool is_type_and_name(std::string_view text);

/// The time code that a line's sample belongs to, if the line is a sample as it is written: `3: [0, 1],`.
std::optional<double> code_of(std::string_view line);

}  // namespace sessile::usda
