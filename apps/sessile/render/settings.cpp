#include "settings.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "sessile/core/error.h"
#include "sessile/scene/read.h"
#include "sessile/scene/spelling.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

/// The scene out of the summary of a run that wrote no scene.json.
std::string scene_in_summary(const fs::path& results) {
  std::ifstream stream(results / "summary.json", std::ios::binary);
  Json::Value summary;
  std::string errors;
  if (!stream || !Json::parseFromStream(Json::CharReaderBuilder{}, stream, &summary, &errors) ||
      !summary["scene"].isObject()) {
    throw FileError(fmt::format("{} holds no scene.json: it is no folder of results", results.string()));
  }
  return summary["scene"].toStyledString();
}

ResolvedScene read_scene_of(const fs::path& results, const std::vector<std::string>& overrides) {
  const fs::path file = results / "scene.json";
  std::error_code error;
  if (fs::exists(file, error)) return read_resolved_scene(file, overrides);
  return read_resolved_text(scene_in_summary(results), (results / "summary.json").string(), overrides);
}

}  // namespace

RenderSettings read_render_settings(const fs::path& results, std::vector<std::string> overrides) {
  for (std::string& each : overrides) each.insert(0, "render.");
  return read_scene_of(results, overrides).scene.render.value_or(RenderSettings{});
}

void check_solids(const RenderSettings& settings, const std::vector<std::string>& labels) {
  const std::vector<std::string_view> known(labels.begin(), labels.end());
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < settings.solids.size(); ++i) {
    const std::string& label = settings.solids[i].label;
    if (std::ranges::find(labels, label) != labels.end()) continue;
    faults.push_back(fmt::format("render.solids[{}].label: there is no solid {}{}", i, in_quotes(label),
                                 known.empty() ? "" : spelling_hint(label, known, "solids")));
  }
  if (!faults.empty()) throw SceneError(std::move(faults));
}

}  // namespace sessile::app
