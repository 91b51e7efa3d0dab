#include "settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "sessile/core/error.h"
#include "sessile/results/results.h"
#include "sessile/scene/spelling.h"

namespace sessile::app {

namespace fs = std::filesystem;

RenderSettings read_render_settings(const fs::path& results, std::vector<std::string> overrides) {
  for (std::string& each : overrides) each.insert(0, "render.");
  return read_resolved_result(results, overrides).scene.render.value_or(RenderSettings{});
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
