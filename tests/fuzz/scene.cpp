#include <fmt/format.h>

#include <string>

#include "fuzz/small_simulation.h"
#include "fuzz/targets.h"
#include "sessile/core/error.h"
#include "sessile/scene/describe.h"
#include "sessile/scene/read.h"
#include "sessile/scene/validate.h"

namespace sessile::fuzz {

void read_scene_json(std::string_view bytes) {
  const ResolvedScene resolved =
      read_resolved_text(std::string(bytes), "scene.json", {}, {}, MeshPlaces::in_its_folder);
  must(validate(resolved.scene).empty(), "a scene was read that is not valid");
  must(!describe(resolved).empty(), "nothing to describe");
  const std::string json = to_json(resolved.scene);
  must(to_json(read_resolved_text(json, "again.json").scene) == json, "a scene does not come back from its own JSON");
  run_when_small(resolved.scene);
}

void read_overrides(std::string_view bytes) {
  static const std::string base = R"({"spacing": 0.1, "time": {"end": 1}, "forces": [{"type": "surface_feature"}],
    "bodies": [{"shape": {"type": "box", "size": [0.3, 0.3, 0.3]}}], "solids": [], "output": {"surface": {}}})";
  std::vector<std::string> overrides;
  while (!bytes.empty() && overrides.size() < 16) {
    const auto end = bytes.find('\n');
    overrides.emplace_back(bytes.substr(0, end));
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
  }
  try {
    static_cast<void>(with_overrides(SurfaceSettings{}, overrides));
  } catch (const SceneError&) {
  }
  const ResolvedScene resolved = read_resolved_text(base, "scene.json", overrides);
  must(validate(resolved.scene).empty(), "overrides made a scene that is not valid");
}

}  // namespace sessile::fuzz
