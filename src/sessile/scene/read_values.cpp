#include "sessile/scene/read_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>
#include <utility>

namespace sessile {

namespace {

constexpr std::size_t most_faults = 1000;  // that are kept; a hostile file could have millions

std::string with_unit(const std::string& text, std::string_view unit) {
  return unit.empty() ? text : text + " " + std::string(unit);
}

/// What a JSON value is, for messages.
std::string found(const Json::Value& json) {
  switch (json.type()) {
    case Json::nullValue:
      return "null";
    case Json::booleanValue:
      return json.asBool() ? "true" : "false";
    case Json::stringValue:
      return "the text " + in_quotes(json.asString());
    case Json::arrayValue:
      return fmt::format("a list of {}", json.size());
    case Json::objectValue:
      return "a group {...}";
    default:
      return fmt::format("the number {}", json.asDouble());
  }
}

}  // namespace

std::string range_text(Range range, std::string_view unit) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const bool bounded_below = range.low > -infinite, bounded_above = range.high < infinite;
  if (bounded_below && bounded_above && !range.above) {
    return with_unit(fmt::format("from {} to {}", range.low, range.high), unit);
  }
  std::string text;
  if (bounded_below) text = fmt::format("{} {}", range.above ? "above" : "at least", range.low);
  if (bounded_above) text += fmt::format("{}at most {}", text.empty() ? "" : " and ", range.high);
  return text.empty() ? text : with_unit(text, unit);
}

std::ptrdiff_t ValueReader::key_offset(const Json::Value& json) const {
  const std::ptrdiff_t offset = json.getOffsetStart();
  return offset < 0 ? offset : text_.key_offset(offset);
}

void ValueReader::fault(const Json::Value& json, const std::string& path, std::string message) {
  if (faults_.size() == most_faults) return;
  const std::ptrdiff_t offset = json.getOffsetStart();
  // An entry of a list has no key, and a value may stand lines below its key: the key is what people look for.
  faults_.push_back({offset < 0 ? offset : text_.key_offset(offset), path, std::move(message)});
}

bool ValueReader::expect(bool right, const Json::Value& json, const std::string& path, std::string_view what) {
  if (!right) fault(json, path, fmt::format("expected {}, found {}", what, found(json)));
  return right;
}

bool ValueReader::read_number(const Json::Value& json, const std::string& path, Range range, std::string_view unit,
                              double& value) {
  if (const auto written = text_.not_finite(json.getOffsetStart())) {
    fault(json, path, *written + " is not a finite number");
    return false;
  }
  const std::string what = unit.empty() ? "a number" : "a number [" + std::string(unit) + "]";
  if (!expect(json.isNumeric(), json, path, what)) return false;
  const double number = json.asDouble();
  if (!range.holds(number)) {
    fault(json, path, fmt::format("must be {}, found {}", range_text(range, unit), number));
    return false;
  }
  value = number;
  return true;
}

void ValueReader::read_text(const Json::Value& json, const std::string& path, std::string& value) {
  if (!expect(json.isString(), json, path, "a text")) return;
  const std::string text = json.asString();
  if (text.find('\0') != std::string::npos) {
    fault(json, path, "holds a NUL character");  // file names and tables would end there
  } else {
    value = text;
  }
}

void ValueReader::read_int(const Json::Value& json, const std::string& path, Range range, std::string_view unit,
                           int& value) {
  constexpr double most = std::numeric_limits<int>::max();
  double number = 0;
  if (!read_number(json, path, range, unit, number)) return;
  if (std::floor(number) != number) {
    fault(json, path, fmt::format("expected a whole number, found {}", number));
  } else if (std::abs(number) > most) {
    fault(json, path, fmt::format("must be at most {:.0f}, found {}", most, number));
  } else {
    value = static_cast<int>(number);
  }
}

void ValueReader::read_vector(const Json::Value& json, const std::string& path, Range range, std::string_view unit,
                              Vec3d& value) {
  const bool three = json.isArray() && json.size() == 3;
  if (!expect(three, json, path, "three numbers [x, y, z]")) return;
  Vec3d read{};
  bool right = true;
  const std::array<double*, 3> components{&read.x, &read.y, &read.z};
  for (Json::ArrayIndex i = 0; i < 3; ++i) {
    right = read_number(json[i], fmt::format("{}[{}]", path, i), range, unit, *components[i]) && right;
  }
  if (right) value = read;
}

void ValueReader::unknown_keys(const Json::Value& json, const std::string& path, std::vector<std::string_view> valid,
                               bool choice) {
  if (choice) valid.insert(valid.begin(), "type");
  for (auto each = json.begin(); each != json.end(); ++each) {
    const std::string key = each.name();
    if (std::find(valid.begin(), valid.end(), key) != valid.end()) continue;
    const std::string shown = in_quotes(key);
    fault(*each, (path.empty() ? "" : path + ".") + shown.substr(1, shown.size() - 2),
          "unknown key" + spelling_hint(key, valid, "keys"));
  }
}

void ValueReader::missing(const Json::Value& json, const std::string& path, std::string_view help,
                          std::string_view unit) {
  const std::string in = unit.empty() ? "" : fmt::format(" [{}]", unit);
  fault(json, path, fmt::format("missing: {}{}", help, in));
}

std::string_view ValueReader::read_type(const Json::Value& json, const std::string& path, bool must,
                                        const std::vector<std::string_view>& names) {
  if (!json.isMember("type")) {
    if (!must) return keep;
    std::string list;
    for (const auto name : names) list += (list.empty() ? "" : ", ") + std::string(name);
    missing(json, path + ".type", "one of " + list, "");
    return {};
  }
  const Json::Value& type = json["type"];
  offsets_.emplace(path + ".type", key_offset(type));
  given_.insert(path + ".type");
  if (!expect(type.isString(), type, path + ".type", "a word")) return {};
  const std::string word = type.asString();
  for (const auto name : names) {
    if (name == word) return name;
  }
  fault(type, path + ".type", "unknown type " + in_quotes(word) + spelling_hint(word, names, "types"));
  return {};
}

/// Links are followed first: one may lead out of the folder as `..` does.
bool ValueReader::is_outside(const std::filesystem::path& file) const {
  std::error_code error;
  const auto place = std::filesystem::weakly_canonical(file, error);
  if (error) return false;  // it cannot be read either, and the system says why
  const auto folder = std::filesystem::weakly_canonical(folder_.empty() ? "." : folder_, error);
  if (error) return true;
  return std::mismatch(folder.begin(), folder.end(), place.begin(), place.end()).first != folder.end();
}

void ValueReader::resolve_file(const Json::Value& json, const std::string& path, std::string& file) {
  std::error_code error;
  const auto resolved = std::filesystem::absolute(folder_ / file, error).lexically_normal();
  std::string extension = resolved.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension != ".obj" && extension != ".stl" && extension != ".ply") {
    fault(json, path, "expected the name of an .obj, .stl or .ply file, found " + in_quotes(file));
  } else if (places_ == MeshPlaces::in_its_folder && json.getOffsetStart() >= 0 && is_outside(resolved)) {
    fault(json, path,
          in_quotes(file) +
              " lies outside the scene's folder: --allow-outside lets a scene read there, "
              "or move the file beside the scene");
  } else if (places_ != MeshPlaces::unasked && !std::filesystem::is_regular_file(resolved, error)) {
    const std::string why = error ? error.message() : "it is no file";
    fault(json, path, "cannot read " + in_quotes(file) + ": " + why);
  }
  file = resolved.string();
}

}  // namespace sessile
