#include "sessile/output/ply_rows.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <iterator>
#include <limits>
#include <utility>

#include "sessile/core/error.h"

namespace sessile {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say little endian");

std::vector<std::string> property_names(const Column& column, bool with_normal) {
  if (column.components == 1) return {column.name};
  if (column.name == "velocity") return {"vx", "vy", "vz"};
  if (column.name == "normal" && with_normal) return {"nx", "ny", "nz"};
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

void PlyRows::vectors(std::span<const float> values, std::string_view x, std::string_view y, std::string_view z) {
  parts_.push_back({{std::string(x), std::string(y), std::string(z)}, std::string(x), values});
}

void PlyRows::column(const Column& column, bool with_normal) {
  Part part{property_names(column, with_normal), column.name, {}};
  std::visit([&](const auto& values) { part.values = std::span(values); }, column.values);
  parts_.push_back(std::move(part));
}

std::string PlyRows::header() const {
  std::string lines;
  for (const Part& part : parts_) {
    const std::string_view type = part.values.index() == 0 ? "float" : "int";
    for (const std::string& name : part.names)
      fmt::format_to(std::back_inserter(lines), "property {} {}\n", type, name);
  }
  return lines;
}

void PlyRows::append_to(std::string& bytes) const {
  std::size_t width = 0, first = 0;  // words in a row; the part's first one
  for (const Part& part : parts_) width += part.names.size();
  std::vector<std::uint32_t> words(width * rows_);
  for (const Part& part : parts_) {
    const std::size_t components = part.names.size();
    std::visit(
        [&](const auto& values) {
          for (std::size_t k = 0; k < values.size(); ++k) {
            words[k / components * width + first + k % components] = word(values[k], part.column);
          }
        },
        part.values);
    first += components;
  }
  bytes.append(reinterpret_cast<const char*>(words.data()), words.size() * sizeof(words[0]));
}

}  // namespace sessile
