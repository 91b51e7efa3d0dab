#include "compare/record.h"

#include <string>
#include "fuzz/scratch_folder.h"
#include "fuzz/targets.h"

namespace sessile::fuzz {

void read_verdict(std::string_view bytes) {
  static const ScratchFolder folder;
  const auto once_more = [](std::string_view json) -> std::string {
    const auto record = app::read_verdict(folder.put("verdict.json", json));
    return record ? app::verdict_json(*record) : "";
  };
  // The first turn makes 0 of -0 and of null. Its scene may be a piece of what was text, which need not be read alone.
  const std::string json = once_more(once_more(bytes));
  must(json.empty() || once_more(json) == json, "a verdict does not come back from its own JSON");
}

}  // namespace sessile::fuzz
