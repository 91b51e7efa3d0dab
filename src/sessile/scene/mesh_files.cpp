#include "sessile/scene/mesh_files.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstring>
#include <system_error>

#include "sessile/core/error.h"
#include "sessile/scene/mesh_words.h"

namespace sessile {

namespace {

static_assert(std::endian::native == std::endian::little, "binary meshes are read as little-endian numbers");

constexpr std::size_t stl_head = 84, stl_record = 50;

/// Calls f(line, number from 1) for each line of a text.
template <class F>
void for_each_line(std::string_view text, F&& f) {
  for (std::size_t at = 0, number = 1; at < text.size(); ++number) {
    const auto end = std::min(text.find('\n', at), text.size());
    f(text.substr(at, end - at), number);
    at = end + 1;
  }
}

/// The index in a corner of an OBJ face, "7", "7/1/2" or counted back from the last corner "-1"; from 0.
std::int64_t obj_index(std::string_view word, std::size_t corners, std::size_t line) {
  std::int64_t index = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
  if (error != std::errc{} || (end != word.data() + word.size() && *end != '/') || index == 0) {
    throw FileError(fmt::format("line {}: expected the number of a corner", line));
  }
  return index > 0 ? index - 1 : static_cast<std::int64_t>(corners) + index;
}

TriangleSoup parse_binary_stl(std::string_view bytes, std::size_t count) {
  check_parts(3 * count, "corners");
  TriangleSoup soup;
  soup.corners.reserve(3 * count);
  for (std::size_t t = 0; t < count; ++t) {
    std::array<float, 12> numbers{};  // the normal, then the corners
    std::memcpy(numbers.data(), bytes.data() + stl_head + t * stl_record, sizeof numbers);
    const auto first = static_cast<std::int64_t>(soup.corners.size());
    for (std::size_t k = 3; k < 12; k += 3) soup.corners.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
    add_polygon(soup, std::array{first, first + 1, first + 2});
  }
  return soup;
}

}  // namespace

void check_parts(std::size_t count, std::string_view what) {
  if (count > most_mesh_parts) throw FileError(fmt::format("it has more than {} {}", most_mesh_parts, what));
}

void add_polygon(TriangleSoup& soup, std::span<const std::int64_t> polygon) {
  check_parts(soup.triangles.size() + polygon.size(), "triangles");
  for (const auto index : polygon) {
    if (index < 0 || index >= static_cast<std::int64_t>(soup.corners.size())) {
      throw FileError(fmt::format("a face names corner {} of {}", index + 1, soup.corners.size()));
    }
  }
  const auto corner = [&](std::size_t k) { return static_cast<std::uint32_t>(polygon[k]); };
  for (std::size_t k = 2; k < polygon.size(); ++k) soup.triangles.push_back({corner(0), corner(k - 1), corner(k)});
}

TriangleSoup parse_obj(std::string_view text) {
  TriangleSoup soup;
  Polygons faces;  // a face may stand before its corners
  for_each_line(text, [&](std::string_view line, std::size_t number) {
    MeshWords words(line);
    const auto kind = words.next();
    if (kind == "v") {
      Vec3d p{};
      if (!words.number(p.x) || !words.number(p.y) || !words.number(p.z)) {
        throw FileError(fmt::format("line {}: expected three numbers", number));
      }
      soup.corners.push_back(p);
      check_parts(soup.corners.size(), "corners");
    } else if (kind == "f") {
      faces.begin();
      check_parts(faces.size(), "faces");
      for (auto word = words.next(); !word.empty() && word.front() != '#'; word = words.next()) {
        faces.corner(obj_index(word, soup.corners.size(), number));
      }
    }
  });
  for (std::size_t i = 0; i < faces.size(); ++i) add_polygon(soup, faces[i]);
  return soup;
}

TriangleSoup parse_stl(std::string_view bytes) {
  // A binary file may start with "solid" too, but its size tells.
  if (bytes.size() >= stl_head) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + stl_head - sizeof count, sizeof count);
    if (bytes.size() == stl_head + stl_record * count) return parse_binary_stl(bytes, count);
  }
  if (!bytes.starts_with("solid")) throw FileError("is no STL file, or its end is missing");
  TriangleSoup soup;
  bool ended = false;
  for_each_line(bytes, [&](std::string_view line, std::size_t number) {
    MeshWords words(line);
    const std::string_view first = words.next();
    ended = ended || first == "endsolid";
    if (first != "vertex") return;
    Vec3d p{};
    if (!words.number(p.x) || !words.number(p.y) || !words.number(p.z)) {
      throw FileError(fmt::format("line {}: expected three numbers", number));
    }
    soup.corners.push_back(p);
    check_parts(soup.corners.size(), "corners");
    const auto count = static_cast<std::int64_t>(soup.corners.size());
    if (count % 3 == 0) add_polygon(soup, std::array{count - 3, count - 2, count - 1});
  });
  if (!ended) throw FileError("its end is missing: no endsolid");
  return soup;
}

}  // namespace sessile
