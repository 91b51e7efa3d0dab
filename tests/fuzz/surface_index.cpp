#include "mesh/surface_index.h"

#include <algorithm>

#include "fuzz/scratch_folder.h"
#include "fuzz/targets.h"

namespace sessile::fuzz {
namespace {

/// What is listed may be removed or replaced, so that it must stand in the folder itself.
void stands_in_the_folder(const std::string& file) {
  must(!file.empty() && file.find('/') == std::string::npos && file != "." && file != "..",
       "a file of surfaces outside their folder");
}

}  // namespace

void read_surface_index(std::string_view bytes) {
  static const ScratchFolder folder;
  app::SurfaceIndex index = app::read_index(folder.put("surface.json", bytes));
  for (const auto* const list : {&index.frames, &index.waiting}) {
    for (const app::SurfaceEntry& frame : *list)
      std::for_each(frame.files.begin(), frame.files.end(), stands_in_the_folder);
  }
  for (const auto& solid : index.solids) stands_in_the_folder(solid.file);
  index.settings = "{}";  // any piece of a line may have passed for them
  const auto once_more = [](const std::string& json) {
    return app::index_json(app::read_index(folder.put("surface.json", json)));
  };
  const std::string json = once_more(app::index_json(index));  // the first turn makes 0 of -0
  must(once_more(json) == json, "a list of surfaces does not come back from its own JSON");
}

}  // namespace sessile::fuzz
