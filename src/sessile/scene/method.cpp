#include "sessile/scene/method.h"

#include <algorithm>
#include <iterator>

#include "sessile/core/error.h"
#include "sessile/scene/fault_lines.h"
#include "sessile/scene/read_values.h"
#include "sessile/scene/validate.h"

namespace sessile {
namespace {

bool of_a_method(const std::string& path) { return touches(path, "pressure") || touches(path, "forces"); }

}  // namespace

ResolvedMethod read_resolved_method(const std::filesystem::path& file) {
  SceneText text = SceneText::from_file(file);
  const Json::Value root = parsed_or_thrown(text, file);
  FaultLines lines(file.string(), text, {});
  lines.add_repeated_keys();
  ResolvedMethod resolved;
  ValueReader reader(text, std::filesystem::absolute(file).parent_path());
  reader.read(root, "", any_number, "", resolved.method);
  for (const auto& found : reader.faults()) lines.add(found.offset, found.path, found.message);
  lines.throw_any();
  for (const auto& [path, offset] : reader.offsets()) resolved.places.emplace(path, lines.place(offset));
  return resolved;
}

Method read_method(const std::filesystem::path& file) { return read_resolved_method(file).method; }

ResolvedScene with_method(const ResolvedScene& scene, const ResolvedMethod& method, const FurtherCheck& further) {
  ResolvedScene result = scene;
  result.scene.pressure = method.method.pressure;
  result.scene.forces = method.method.forces;
  std::erase_if(result.given, of_a_method);
  std::erase_if(result.places, [](const auto& place) { return !place.first.empty() && of_a_method(place.first); });
  for (const auto& [path, place] : method.places) {
    if (!path.empty() && of_a_method(path)) {
      result.places.insert_or_assign(path, place);
      result.given.insert(path);
    }
  }
  std::vector<Fault> faults = validate(result.scene);
  if (further) std::ranges::move(further(result.scene), std::back_inserter(faults));
  if (faults.empty()) return result;
  std::vector<std::string> lines;
  for (const Fault& fault : faults) lines.push_back(result.locate(fault));
  throw SceneError(std::move(lines));
}

}  // namespace sessile
