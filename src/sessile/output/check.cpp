#include "sessile/output/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

#include "sessile/output/frames.h"
#include "sessile/output/snapshot.h"
#include "sessile/output/surfaces.h"
#include "sessile/scene/spelling.h"

namespace sessile {
namespace {

void check_names(const std::vector<std::string>& names, const std::vector<std::string>& known, std::string_view key,
                 std::string_view kind, std::vector<Fault>& faults) {
  const std::vector<std::string_view> candidates(known.begin(), known.end());
  constexpr std::size_t most_collected = 101;  // a hundred are told, and that there are more
  for (std::size_t i = 0; i < names.size() && faults.size() < most_collected; ++i) {
    if (std::find(known.begin(), known.end(), names[i]) != known.end()) continue;
    Fault fault{fmt::format("{}[{}]", key, i), fmt::format("unknown {} {}", kind, in_quotes(names[i])), {}};
    fault.message += spelling_hint(names[i], candidates, fmt::format("{}s", kind));
    if (names[i].starts_with(acceleration_prefix)) fault.uses.emplace_back("forces");
    faults.push_back(std::move(fault));
  }
}

std::vector<std::string> names_of(const auto& formats) {
  std::vector<std::string> names;
  for (const auto& format : formats) names.emplace_back(format.name);
  return names;
}

/// All fields that a frame of this scene can hold.
std::vector<std::string> fields_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const KnownColumn& column : known_columns()) {
    if (!column.name.starts_with(acceleration_prefix)) names.emplace_back(column.name);
  }
  std::vector<std::string_view> forces{"gravity", "viscosity", "pressure"};
  for (const Force& force : scene.forces) std::visit([&](const auto& model) { forces.push_back(model.name); }, force);
  for (auto force = forces.begin(); force != forces.end(); ++force) {
    // As in Simulation::acceleration_names(), the second force of a name gets a number.
    const auto same = std::count(forces.begin(), force, *force);
    names.push_back(fmt::format("{}{}{}", acceleration_prefix, *force, same ? fmt::format("_{}", same + 1) : ""));
  }
  return names;
}

}  // namespace

std::vector<Fault> check_output(const Scene& scene) {
  std::vector<Fault> faults;
  check_names(scene.output.formats, names_of(frame_formats()), "output.formats", "format", faults);
  if (scene.output.surface) {
    check_names(scene.output.surface->formats, names_of(surface_formats()), "output.surface.formats", "format", faults);
  }
  check_names(scene.output.columns, fields_of(scene), "output.fields", "field", faults);
  return faults;
}

}  // namespace sessile
