#include "sessile/output/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string_view>
#include <variant>

#include "sessile/output/frames.h"
#include "sessile/output/snapshot.h"

namespace sessile {
namespace {

/// Letters to insert, drop or change to make b of a.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// ` (did you mean "vtp"?)` when a known word is near, or a list of all.
std::string hint(std::string_view word, const std::vector<std::string>& known) {
  const auto nearest = std::min_element(known.begin(), known.end(),
                                        [&](const auto& a, const auto& b) { return edits(word, a) < edits(word, b); });
  if (edits(word, *nearest) <= std::max<std::size_t>(1, nearest->size() / 3)) {
    return fmt::format(" (did you mean \"{}\"?)", *nearest);
  }
  return fmt::format(" (there are {})", fmt::join(known, ", "));
}

void check_names(const std::vector<std::string>& names, const std::vector<std::string>& known, std::string_view key,
                 std::string_view kind, std::vector<std::string>& faults) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto end = names.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(known.begin(), known.end(), names[i]) == known.end()) {
      faults.push_back(fmt::format("{}[{}]: unknown {} \"{}\"{}", key, i, kind, names[i], hint(names[i], known)));
    } else if (std::find(names.begin(), end, names[i]) != end) {
      faults.push_back(fmt::format("{}[{}]: {} \"{}\" is listed twice", key, i, kind, names[i]));
    }
  }
}

std::vector<std::string> formats_of_frames() {
  std::vector<std::string> names;
  for (const FrameFormat& format : frame_formats()) names.emplace_back(format.name);
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

std::vector<std::string> check_output(const Scene& scene) {
  std::vector<std::string> faults;
  check_names(scene.output.formats, formats_of_frames(), "output.formats", "format", faults);
  check_names(scene.output.columns, fields_of(scene), "output.fields", "field", faults);
  return faults;
}

}  // namespace sessile
