#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "sessile/core/error.h"
#include "sessile/scene/mesh_files.h"
#include "sessile/scene/mesh_words.h"

namespace sessile {

namespace {

enum class Format { ascii, little, big };
enum class Number { i8, u8, i16, u16, i32, u32, f32, f64 };

constexpr std::array<std::pair<std::string_view, Number>, 16> number_names{{{"char", Number::i8},
                                                                            {"uchar", Number::u8},
                                                                            {"short", Number::i16},
                                                                            {"ushort", Number::u16},
                                                                            {"int", Number::i32},
                                                                            {"uint", Number::u32},
                                                                            {"float", Number::f32},
                                                                            {"double", Number::f64},
                                                                            {"int8", Number::i8},
                                                                            {"uint8", Number::u8},
                                                                            {"int16", Number::i16},
                                                                            {"uint16", Number::u16},
                                                                            {"int32", Number::i32},
                                                                            {"uint32", Number::u32},
                                                                            {"float32", Number::f32},
                                                                            {"float64", Number::f64}}};

Number number_named(std::string_view name) {
  for (const auto& [word, number] : number_names) {
    if (word == name) return number;
  }
  throw FileError("its PLY header names an unknown type");
}

struct Property {
  std::string_view name;
  bool list = false;
  Number count = Number::u8;
  Number type = Number::f32;
};

struct Element {
  std::string_view name;
  double count = 0;
  std::vector<Property> properties;
};

/// Takes numbers off the body of a PLY file.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, Format format) : format_(format), bytes_(bytes), words_(bytes) {}

  double next(Number type) {
    if (format_ == Format::ascii) {
      double value = 0;
      if (!words_.number(value)) throw FileError("its numbers end too early or are none");
      return value;
    }
    switch (type) {
      case Number::i8:
        return static_cast<double>(take<std::int8_t>());
      case Number::u8:
        return static_cast<double>(take<std::uint8_t>());
      case Number::i16:
        return static_cast<double>(take<std::int16_t>());
      case Number::u16:
        return static_cast<double>(take<std::uint16_t>());
      case Number::i32:
        return static_cast<double>(take<std::int32_t>());
      case Number::u32:
        return static_cast<double>(take<std::uint32_t>());
      case Number::f32:
        return static_cast<double>(take<float>());
      case Number::f64:
        return take<double>();
    }
    return 0;
  }

 private:
  template <class T>
  T take() {
    if (bytes_.size() < sizeof(T)) throw FileError("its numbers end too early");
    std::array<char, sizeof(T)> raw{};
    std::copy_n(bytes_.begin(), sizeof(T), raw.begin());
    bytes_.remove_prefix(sizeof(T));
    if (format_ == Format::big) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }

  Format format_;
  std::string_view bytes_;
  MeshWords words_;
};

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
  std::string_view body;
};

Header parse_header(std::string_view bytes) {
  Header header;
  for (std::size_t at = 0; at < bytes.size();) {
    const auto end = bytes.find('\n', at);
    if (end == std::string_view::npos) break;
    MeshWords words(bytes.substr(at, end - at));
    const auto first = words.next();
    if (at == 0 && first != "ply") break;
    at = end + 1;
    if (first == "end_header") {
      header.body = bytes.substr(at);
      return header;
    }
    if (first == "format") {
      const auto format = words.next();
      header.format = format == "ascii" ? Format::ascii : format == "binary_big_endian" ? Format::big : Format::little;
      if (header.format == Format::little && format != "binary_little_endian")
        throw FileError("its PLY format is unknown");
    } else if (first == "element") {
      auto& element = header.elements.emplace_back();
      element.name = words.next();
      if (!words.number(element.count) || !(element.count >= 0)) throw FileError("its PLY header gives no count");
    } else if (first == "property") {
      if (header.elements.empty()) throw FileError("its PLY header names a property of nothing");
      Property property;
      auto type = words.next();
      property.list = type == "list";
      if (property.list) {
        property.count = number_named(words.next());
        type = words.next();
      }
      property.type = number_named(type);
      property.name = words.next();
      header.elements.back().properties.push_back(property);
    }
  }
  throw FileError("has no complete PLY header");
}

/// An index as a whole number; what is none becomes -1, which no corner has.
std::int64_t whole(double value) { return std::abs(value) < 1e15 ? static_cast<std::int64_t>(value) : -1; }

}  // namespace

TriangleSoup parse_ply(std::string_view bytes) {
  const Header header = parse_header(bytes);
  PlyBody body(header.body, header.format);
  TriangleSoup soup;
  Polygons faces;
  for (const auto& element : header.elements) {
    if (element.properties.empty()) continue;
    // Each entry takes a byte at least: a count that lies runs into the end of the body.
    for (double i = 0; i < element.count; ++i) {
      Vec3d corner{std::numeric_limits<double>::quiet_NaN(), 0, 0};
      for (const auto& property : element.properties) {
        if (property.list) {
          const double count = body.next(property.count);
          const bool indices = property.name == "vertex_indices" || property.name == "vertex_index";
          const bool polygon = element.name == "face" && indices;
          if (polygon) faces.begin();
          check_parts(faces.size(), "faces");
          for (double k = 0; k < count; ++k) {
            const double index = body.next(property.type);
            if (polygon) faces.corner(whole(index));
          }
          continue;
        }
        const double value = body.next(property.type);
        if (property.name == "x") corner.x = value;
        if (property.name == "y") corner.y = value;
        if (property.name == "z") corner.z = value;
      }
      if (element.name == "vertex") soup.corners.push_back(corner);
      check_parts(soup.corners.size(), "corners");
    }
  }
  for (std::size_t i = 0; i < faces.size(); ++i) add_polygon(soup, faces[i]);
  return soup;
}

}  // namespace sessile
