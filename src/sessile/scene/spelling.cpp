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
    return " (did you mean " + in_quotes(best) + "?)";
  }
  std::string list = " (valid " + std::string(kind) + ": ";
  constexpr std::size_t most = 100;
  for (std::size_t i = 0; i < std::min(most, candidates.size()); ++i)
    list += (i == 0 ? "" : ", ") + printable(candidates[i]);
  return list + (candidates.size() > most ? ", ...)" : ")");
}

std::string printable(std::string_view text) {
  constexpr std::size_t longest = 60;
  const auto at = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  std::string result;
  for (std::size_t k = 0; k < std::min(longest, text.size()); ++k) {
    // U+0080 to U+009F are control characters too: in UTF-8 two bytes, the first of them 0xC2.
    const bool second_set = at(k) == 0xc2U && at(k + 1) >= 0x80U && at(k + 1) < 0xa0U;
    if (second_set) ++k;
    result += second_set || std::iscntrl(static_cast<int>(at(k))) != 0 ? '?' : text[k];
  }
  return result + (text.size() > longest ? "..." : "");
}

std::string in_quotes(std::string_view text) { return '"' + printable(text) + '"'; }

}  // namespace sessile
