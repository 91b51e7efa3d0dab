#include "sessile/scene/spelling.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <vector>

namespace sessile {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto same = [](char p, char q) {
    return std::tolower(static_cast<unsigned char>(p)) == std::tolower(static_cast<unsigned char>(q));
  };
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0U : 1U)});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1])) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
  // A hostile key may be megabytes long; no candidate is near it.
  if (word.size() > 64) return {};
  const std::size_t limit = std::min((word.size() + 2) / 3, word.empty() ? 0 : word.size() - 1);
  std::size_t least = std::numeric_limits<std::size_t>::max();
  std::string_view best;
  for (const auto candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return least <= limit ? best : std::string_view{};
}

std::string spelling_hint(std::string_view word, std::span<const std::string_view> candidates, std::string_view kind) {
  if (const auto best = nearest(word, candidates); !best.empty()) {
    return " (did you mean \"" + std::string(best) + "\"?)";
  }
  std::string list = " (valid " + std::string(kind) + ": ";
  for (std::size_t i = 0; i < candidates.size(); ++i) list += (i == 0 ? "" : ", ") + std::string(candidates[i]);
  return list + ")";
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string result = "\"";
  for (const char c : text.substr(0, longest)) {
    result += std::iscntrl(static_cast<unsigned char>(c)) != 0 ? '?' : c;
  }
  return result + (text.size() > longest ? "...\"" : "\"");
}

}  // namespace sessile
