#include "sessile/scene/read.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "sessile/scene/fault_lines.h"
#include "sessile/scene/overrides.h"
#include "sessile/scene/read_values.h"
#include "sessile/scene/scene_text.h"
#include "sessile/scene/validate.h"

namespace sessile {

namespace {

/// Offsets below zero stand for overrides: -1 is the first.
std::ptrdiff_t mark_of(std::size_t override_index) { return -static_cast<std::ptrdiff_t>(override_index) - 1; }

std::vector<Override> split_overrides(std::span<const std::string> overrides) {
  std::vector<Override> split;
  for (const auto& each : overrides) split.push_back(split_override(each));
  return split;
}

void apply_overrides(std::span<const Override> overrides, Json::Value& root, FaultLines& lines) {
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const Fault fault = apply_override(overrides[i], mark_of(i), root);
    if (!fault.message.empty()) lines.add(mark_of(i), fault.path, fault.message);
  }
}

ResolvedScene resolve(SceneText text, const std::filesystem::path& file, std::span<const std::string> overrides,
                      const FurtherCheck& further, MeshPlaces places) {
  Json::Value root = parsed_or_thrown(text, file);

  const std::vector<Override> split = split_overrides(overrides);
  FaultLines lines(file.string(), text, split);
  lines.add_repeated_keys();
  apply_overrides(split, root, lines);

  ResolvedScene resolved;
  ValueReader reader(text, std::filesystem::absolute(file).parent_path(), places);
  reader.read(root, "", any_number, "", resolved.scene);
  for (const auto& found : reader.faults()) lines.add(found.offset, found.path, found.message);
  resolved.given = reader.given();
  for (const auto& [path, offset] : reader.offsets()) resolved.places.emplace(path, lines.place(offset));

  // What the parts make together, unless one of those parts is at fault already.
  if (root.isObject()) {
    auto together = validate(resolved.scene);
    if (further) std::ranges::move(further(resolved.scene), std::back_inserter(together));
    std::erase_if(together, [&](const Fault& fault) { return lines.spoils(fault); });
    for (const auto& fault : together) {
      std::string path = fault.path;
      while (!path.empty() && !reader.offsets().contains(path)) path = around(path);
      lines.add(reader.offsets().at(path), fault.path, fault.message);
    }
  }
  lines.throw_any();
  return resolved;
}

}  // namespace

std::string ResolvedScene::locate(const Fault& fault) const {
  std::string path = fault.path;
  while (!path.empty() && !places.contains(path)) path = around(path);
  const auto place = places.find(path);
  return place == places.end() ? text(fault) : line_for(place->second, fault.path, fault.message);
}

ResolvedScene read_resolved_scene(const std::filesystem::path& file, std::span<const std::string> overrides,
                                  const FurtherCheck& further, MeshPlaces places) {
  return resolve(SceneText::from_file(file), file, overrides, further, places);
}

ResolvedScene read_resolved_text(std::string text, const std::string& name, std::span<const std::string> overrides,
                                 const FurtherCheck& further, MeshPlaces places) {
  return resolve(SceneText(std::move(text)), name, overrides, further, places);
}

SurfaceSettings with_overrides(const SurfaceSettings& settings, std::span<const std::string> overrides) {
  SceneText nothing("{}");
  Json::Value root = parsed_or_thrown(nothing, "");
  const std::vector<Override> split = split_overrides(overrides);
  FaultLines lines("", nothing, split);
  apply_overrides(split, root, lines);
  SurfaceSettings result = settings;
  ValueReader reader(nothing, {});
  reader.read(root, "", any_number, "", result);
  for (const auto& found : reader.faults()) lines.add(found.offset, found.path, found.message);
  lines.throw_any();
  return result;
}

Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read_resolved_scene(file, overrides).scene;
}

}  // namespace sessile
