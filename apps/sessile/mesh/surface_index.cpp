#include "surface_index.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "sessile/core/error.h"
#include "sessile/core/memory_limit.h"
#include "sessile/output/json_object.h"
#include "sessile/scene/input_file.h"
#include "sessile/scene/json_text.h"

namespace sessile::app {
namespace {

constexpr int version = 1;
constexpr std::uintmax_t largest = std::uintmax_t{256} << 20;  // bytes; a million frames take 120 MiB

/// A million frames in five formats are eleven million values; but what is read takes an eighth of the memory at most.
std::size_t most_values() {
  constexpr double bytes_each = 200, most = 16e6;
  return static_cast<std::size_t>(std::min(most, memory_limit().bytes / 8 / bytes_each));
}

std::string quoted(const std::string& text) { return Json::valueToQuotedString(text.c_str()); }

template <class T, class F>
std::string list_of(const std::vector<T>& entries, F&& text_of) {
  std::string text;
  for (const T& each : entries) text += fmt::format("{}\n    {}", text.empty() ? "" : ",", text_of(each));
  return text.empty() ? "[]" : fmt::format("[{}\n  ]", text);
}

std::string frame_json(const SurfaceEntry& entry) {
  std::string files;
  for (const std::string& file : entry.files) files += fmt::format("{}{}", files.empty() ? "" : ", ", quoted(file));
  return fmt::format(R"({{"number": {}, "time": {}, "file": {}, "triangles": {}, "files": [{}]}})", entry.number,
                     entry.time, quoted(entry.files.empty() ? "" : entry.files.front()), entry.triangles, files);
}

/// Whether it is a file of this folder that bears a name of ours: what is listed may be removed one day.
bool is_ours(const std::string& name, std::string_view prefix) {
  return name.starts_with(prefix) && name.find('/') == std::string::npos;
}

SurfaceEntry entry_of(const Json::Value& json) {
  SurfaceEntry entry{json["number"].asInt64(), json["time"].asDouble(), {}, json["triangles"].asUInt64()};
  for (const Json::Value& file : json["files"]) {
    if (is_ours(file.asString(), "surface")) entry.files.push_back(file.asString());
  }
  return entry;
}

}  // namespace

bool SurfaceIndex::same_origin(const SurfaceIndex& other) const {
  return source == other.source && spacing == other.spacing && settings == other.settings;
}

std::string index_json(const SurfaceIndex& index) {
  JsonObject object(0);
  object.add("version", std::int64_t{version})
      .add("source", index.source)
      .add("spacing", index.spacing)
      .raw("up", fmt::format("[{}, {}, {}]", index.up.x, index.up.y, index.up.z))
      .raw("settings", index.settings)
      .raw("frames", list_of(index.frames, frame_json))
      .raw("waiting", list_of(index.waiting, frame_json))
      .raw("solids", list_of(index.solids, [](const SurfaceIndex::Solid& solid) {
             return fmt::format(R"({{"label": {}, "file": {}}})", quoted(solid.label), quoted(solid.file));
           }));
  return object.text() + "\n";
}

SurfaceIndex read_index(const std::filesystem::path& file) {
  SurfaceIndex index;
  std::string text;
  try {
    text = read_input(file, largest);
    const auto parsed = parsed_json(text, most_values());
    if (!parsed || !parsed->isObject()) return {};
    const Json::Value& json = *parsed;
    if (json["version"].asInt() != version) return {};
    index.source = json["source"].asString();
    index.spacing = json["spacing"].asDouble();
    for (const Json::Value& frame : json["frames"]) index.frames.push_back(entry_of(frame));
    for (const Json::Value& frame : json["waiting"]) index.waiting.push_back(entry_of(frame));
    for (const Json::Value& solid : json["solids"]) {
      const std::string name = solid["file"].asString();
      if (is_ours(name, "solid_")) index.solids.push_back({solid["label"].asString(), name});
    }
  } catch (const FileError&) {
    return {};
  } catch (const Json::Exception&) {
    return {};
  }
  // The settings as the file has them, to the letter: numbers that went through a parser need not come out the same.
  std::istringstream in(text);
  constexpr std::string_view key = "  \"settings\": ";
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(key) && line.ends_with(','))
      index.settings = line.substr(key.size(), line.size() - 1 - key.size());
  }
  return index;
}

}  // namespace sessile::app
