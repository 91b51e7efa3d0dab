#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace sessile::app {

/// Frames from a first to a last number, each `step`-th.
struct FrameRange {
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t step = 1;

  bool holds(std::int64_t number) const { return number >= first && number <= last && (number - first) % step == 0; }
};

/// `12`, `10:20`, `10:`, `:20` or `0:100:4`. Throws SceneError with a sentence for anything else.
FrameRange read_frame_range(const std::string& text);

}  // namespace sessile::app
