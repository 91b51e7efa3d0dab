#include "frame_range.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <string_view>

#include "sessile/core/error.h"
#include "sessile/scene/spelling.h"

namespace sessile::app {

FrameRange read_frame_range(const std::string& text) {
  FrameRange range;
  const std::array<std::int64_t*, 3> parts{&range.first, &range.last, &range.step};
  const auto fault = [&] {
    return SceneError(fmt::format("--frames: expected 12, 10:20, 10:, :20 or 0:100:4, found {}", in_quotes(text)));
  };
  std::size_t part = 0, begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1, ++part) {
    end = text.find(':', begin);
    if (part == parts.size()) throw fault();
    const std::string_view word = std::string_view(text).substr(begin, end - begin);
    if (word.empty() && part < 2 && text.size() > 1) continue;
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), *parts[part]);
    if (word.empty() || error != std::errc{} || rest != word.data() + word.size()) throw fault();
  }
  if (part == 1) range.last = range.first;
  if (range.first < 0 || range.last < range.first || range.step < 1) throw fault();
  return range;
}

}  // namespace sessile::app
