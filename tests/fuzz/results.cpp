#include "sessile/results/results.h"

#include <cmath>

#include "fuzz/scratch_folder.h"
#include "fuzz/targets.h"
#include "sessile/core/error.h"
#include "sessile/output/frames.h"

namespace sessile::fuzz {
namespace {

/// Two frames, one with a time of its own.
void add_frames(const ScratchFolder& folder) {
  Snapshot frame{0.5, 7, {0, 0, 1}, {}};
  folder.put("frame_000000.ply", encode_ply(frame));
  folder.put("frame_000001.ply", encode_ply(frame));
}

void open(const ScratchFolder& folder) {
  const Results results = open_results(folder.path());
  must(results.frames.size() == 2, "frames were lost");
  for (const ResultFrame& frame : results.frames) must(std::isfinite(frame.time), "a frame at no time");
}

}  // namespace

void read_results(std::string_view bytes) {
  static const ScratchFolder own, old, listed;
  static const bool once = [] {
    add_frames(own);
    add_frames(old);
    add_frames(listed);
    listed.put("scene.json", R"({"spacing": 0.1, "time": {"end": 1},
      "bodies": [{"shape": {"type": "box", "size": [0.3, 0.3, 0.3]}}]})");
    return true;
  }();
  static_cast<void>(once);
  own.put("scene.json", bytes);
  old.put("summary.json", bytes);
  listed.put("frames.pvd", bytes);
  for (const auto* const folder : {&own, &old}) {
    try {
      open(*folder);
    } catch (const FileError&) {
    }
  }
  open(listed);
}

}  // namespace sessile::fuzz
