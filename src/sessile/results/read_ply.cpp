#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "sessile/core/error.h"
#include "sessile/results/frame_files.h"

namespace sessile {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say little endian");

/// Takes the prefix off the text; false where it begins otherwise.
bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

template <class T>
bool take_number(std::string_view& text, T& value) {
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  return true;
}

/// A property as the header lists it; each takes four bytes.
struct Property {
  std::string_view name;
  bool whole = false;
};

struct PlyHeader {
  FrameMoment moment{};
  std::uint64_t count = 0;
  std::vector<Property> properties;
  std::string_view body;
};

std::string_view take_line(std::string_view& rest) {
  const auto end = rest.find('\n');
  if (end == std::string_view::npos) throw FileError("its PLY header is cut short");
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end + 1);
  return line;
}

std::optional<FrameMoment> moment_of(std::string_view comment) {
  FrameMoment moment;
  if (!take(comment, "comment Sessile, time ") || !take_number(comment, moment.time)) return {};
  if (!take(comment, " s, step ") || !take_number(comment, moment.step)) return {};
  return comment.empty() && std::isfinite(moment.time) ? std::optional(moment) : std::nullopt;
}

PlyHeader parse_header(std::string_view bytes) {
  const auto not_ours = [] { return FileError("it is a PLY file, but no frame that `sessile run` wrote"); };
  PlyHeader header;
  if (take_line(bytes) != "ply") throw FileError("it is no PLY file");
  if (take_line(bytes) != "format binary_little_endian 1.0") throw not_ours();
  const auto moment = moment_of(take_line(bytes));
  if (!moment) throw not_ours();
  header.moment = *moment;
  std::string_view line = take_line(bytes);
  if (!take(line, "element vertex ") || !take_number(line, header.count) || !line.empty()) throw not_ours();
  while ((line = take_line(bytes)) != "end_header") {
    if (line.starts_with("element face")) throw FileError("it holds a surface, not particles");
    Property property;
    if (take(line, "property int ")) {
      property.whole = true;
    } else if (!take(line, "property float ")) {
      throw not_ours();
    }
    property.name = line;
    header.properties.push_back(property);
  }
  header.body = bytes;
  return header;
}

/// The column that begins with property `i`; the properties of vectors stand in a row.
Column column_at(const std::vector<Property>& properties, std::size_t i) {
  const auto named = [&](std::size_t k, std::string_view name) {
    return i + k < properties.size() && properties[i + k].name == name &&
           properties[i + k].whole == properties[i].whole;
  };
  const auto row = [&](std::string_view x, std::string_view y, std::string_view z) {
    return named(0, x) && named(1, y) && named(2, z);
  };
  std::string name(properties[i].name);
  if (row("vx", "vy", "vz")) return {"velocity", "", 3, {}};
  if (row("nx", "ny", "nz")) return {"normal", "", 3, {}};
  if (name.ends_with("_x")) {
    name.resize(name.size() - 2);
    if (row(name + "_x", name + "_y", name + "_z")) return {name, "", 3, {}};
    name += "_x";
  }
  return {name, "", 1, {}};
}

std::string unit_of(std::string_view column) {
  for (const KnownColumn& known : known_columns()) {
    const bool same = known.name == column;
    if (same || (known.name.starts_with(acceleration_prefix) && column.starts_with(acceleration_prefix))) {
      return std::string(known.unit);
    }
  }
  return "";
}

/// Takes words out of rows: the value of each row at `first`, `first` + 1 ...
template <class From, class To>
std::vector<To> values_at(std::string_view body, std::size_t width, std::size_t first, std::size_t components) {
  const std::size_t rows = body.size() / (4 * width);
  std::vector<To> values;
  values.reserve(rows * components);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t k = 0; k < components; ++k) {
      From value{};
      std::memcpy(&value, body.data() + 4 * (row * width + first + k), sizeof value);
      values.push_back(value);
    }
  }
  return values;
}

}  // namespace

std::optional<FrameMoment> ply_moment(std::string_view beginning) {
  const auto at = beginning.find("\ncomment Sessile, time ");
  if (at == std::string_view::npos) return {};
  const std::string_view line = beginning.substr(at + 1);
  return moment_of(line.substr(0, line.find('\n')));
}

Snapshot parse_ply_frame(std::string_view bytes) {
  const PlyHeader header = parse_header(bytes);
  const auto& properties = header.properties;
  const std::size_t width = properties.size();
  const auto is = [&](std::size_t i, std::string_view name) {
    return i < width && properties[i].name == name && !properties[i].whole;
  };
  if (!is(0, "x") || !is(1, "y") || !is(2, "z")) throw FileError("its PLY header does not begin with x, y and z");
  // Divided, not multiplied: a count that lies could overflow.
  if (header.body.size() % (4 * width) != 0 || header.body.size() / (4 * width) != header.count) {
    throw FileError(fmt::format("it holds {} bytes of particles in place of {} x {}: it is cut short or changed",
                                header.body.size(), header.count, 4 * width));
  }
  Snapshot snapshot{header.moment.time, header.moment.step, values_at<float, float>(header.body, width, 0, 3), {}};
  for (std::size_t i = 3; i < width;) {
    Column column = column_at(properties, i);
    column.unit = unit_of(column.name);
    const auto components = static_cast<std::size_t>(column.components);
    if (properties[i].whole) {
      column.values = values_at<std::int32_t, std::int64_t>(header.body, width, i, components);
    } else {
      column.values = values_at<float, float>(header.body, width, i, components);
    }
    snapshot.columns.push_back(std::move(column));
    i += components;
  }
  return snapshot;
}

}  // namespace sessile
