#include "selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <set>
#include <string_view>

#include "sessile/core/error.h"

namespace sessile::app {
namespace {

/// The parts of a text between separators; one more than there are of those.
std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const auto end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::int64_t number(std::string_view text, const std::string& whole) {
  std::int64_t value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || rest != text.data() + text.size()) {
    throw Error(fmt::format("expected frames such as 10:20, ::5 or 0,3,-1, found \"{}\"", whole));
  }
  return value;
}

}  // namespace

std::vector<std::size_t> selected(const std::string& text, std::size_t count) {
  const auto n = static_cast<std::int64_t>(count);
  std::set<std::size_t> places;
  for (const std::string_view part : parts_of(text, ',')) {
    const auto bounds = parts_of(part, ':');
    if (bounds.size() == 1) {
      const std::int64_t at = number(part, text), place = at < 0 ? at + n : at;
      if (place < 0 || place >= n) throw Error(fmt::format("there is no frame {}: there are {}", at, n));
      places.insert(static_cast<std::size_t>(place));
      continue;
    }
    const auto bound = [&](std::size_t k) {
      return k < bounds.size() && !bounds[k].empty() ? std::optional(number(bounds[k], text)) : std::nullopt;
    };
    const auto from_start = [&](std::int64_t at) { return std::clamp<std::int64_t>(at < 0 ? at + n : at, 0, n); };
    const std::int64_t step = bound(2).value_or(1);
    if (bounds.size() > 3 || step <= 0)
      throw Error(fmt::format("\"{}\" is no range: begin:end or begin:end:step, with a step above 0", part));
    const std::int64_t end = from_start(bound(1).value_or(n));
    for (std::int64_t at = from_start(bound(0).value_or(0)); at < end; at += std::min(step, n)) {
      places.insert(static_cast<std::size_t>(at));
    }
  }
  return {places.begin(), places.end()};
}

}  // namespace sessile::app
