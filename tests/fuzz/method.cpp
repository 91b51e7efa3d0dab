#include "sessile/scene/method.h"

#include "fuzz/scratch_folder.h"
#include "fuzz/targets.h"
#include "sessile/scene/validate.h"

namespace sessile::fuzz {

void read_method_json(std::string_view bytes) {
  static const ScratchFolder folder;
  static const ResolvedScene scene = read_resolved_text(
      R"({"spacing": 0.1, "time": {"end": 1}, "bodies": [{"shape": {"type": "box", "size": [0.3, 0.3, 0.3]}}]})",
      "scene.json");
  const ResolvedMethod method = read_resolved_method(folder.put("method.json", bytes));
  must(validate(with_method(scene, method).scene).empty(), "a method made a scene that is not valid");
}

}  // namespace sessile::fuzz
