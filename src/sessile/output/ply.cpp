#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <iterator>
#include <limits>

#include "sessile/core/error.h"
#include "sessile/output/frames.h"

namespace sessile {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say little endian");

/// Names of a column's properties; vx and nx are what Blender and MeshLab look for.
std::vector<std::string> property_names(const Column& column) {
  if (column.components == 1) return {column.name};
  if (column.name == "velocity") return {"vx", "vy", "vz"};
  if (column.name == "normal") return {"nx", "ny", "nz"};
  return {column.name + "_x", column.name + "_y", column.name + "_z"};
}

/// What a row holds of a float: its four bytes.
std::uint32_t word(float value, const std::string&) { return std::bit_cast<std::uint32_t>(value); }

std::uint32_t word(std::int64_t value, const std::string& name) {
  if (value < std::numeric_limits<std::int32_t>::min() || value > std::numeric_limits<std::int32_t>::max()) {
    throw Error(fmt::format("PLY holds whole numbers of 32 bits only; {} reached {}", name, value));
  }
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(value));
}

}  // namespace

std::string encode_ply(const Snapshot& snapshot) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment Sessile, time {} s, step {}\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n",
      snapshot.time, snapshot.step, snapshot.size());
  std::size_t width = 3;  // words in a row: every property has four bytes
  for (const Column& column : snapshot.columns) {
    const std::string_view type = std::holds_alternative<std::vector<float>>(column.values) ? "float" : "int";
    for (const std::string& name : property_names(column)) {
      fmt::format_to(std::back_inserter(bytes), "property {} {}\n", type, name);
      ++width;
    }
  }
  bytes += "end_header\n";

  std::vector<std::uint32_t> words(width * snapshot.size());
  std::size_t first = 0;  // of the column in each row
  const auto put = [&](const auto& values, std::size_t components, const std::string& name) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      words[k / components * width + first + k % components] = word(values[k], name);
    }
    first += components;
  };
  put(snapshot.points, 3, "x");
  for (const Column& column : snapshot.columns) {
    std::visit([&](const auto& values) { put(values, static_cast<std::size_t>(column.components), column.name); },
               column.values);
  }
  bytes.append(reinterpret_cast<const char*>(words.data()), words.size() * sizeof(words[0]));
  return bytes;
}

}  // namespace sessile
