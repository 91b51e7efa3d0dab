#include "sessile/core/radix_sort.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

namespace sessile {

void counts_to_starts(std::span<DigitCounts> chunks) {
  std::int32_t start = 0;
  for (std::size_t digit = 0; digit < std::tuple_size_v<DigitCounts>; ++digit) {
    for (DigitCounts& count : chunks) start += std::exchange(count[digit], start);
  }
}

void radix_sort(Array<KeyedPlace>& items, Array<KeyedPlace>& scratch, int bits) {
  constexpr std::ptrdiff_t chunk = 1 << 15;
  constexpr std::size_t digits = std::size_t{1} << digit_bits;
  const auto n = static_cast<std::ptrdiff_t>(items.size());
  const std::ptrdiff_t chunks = (n + chunk - 1) / chunk;
  std::vector<DigitCounts> counts(static_cast<std::size_t>(chunks));
  scratch.resize(items.size());

  for (int shift = 0; shift < bits; shift += digit_bits) {
    const auto digit = [shift](const KeyedPlace& item) { return (item.key >> shift) & (digits - 1); };
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t c = 0; c < chunks; ++c) {
      auto& count = counts[static_cast<std::size_t>(c)];
      count.fill(0);
      for (auto k = c * chunk; k < std::min(n, (c + 1) * chunk); ++k)
        ++count[digit(items[static_cast<std::size_t>(k)])];
    }
    counts_to_starts(counts);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t c = 0; c < chunks; ++c) {
      auto& next = counts[static_cast<std::size_t>(c)];
      for (auto k = c * chunk; k < std::min(n, (c + 1) * chunk); ++k) {
        const KeyedPlace& item = items[static_cast<std::size_t>(k)];
        scratch[static_cast<std::size_t>(next[digit(item)]++)] = item;
      }
    }
    items.swap(scratch);
  }
  assert(std::is_sorted(items.begin(), items.end(),
                        [](const KeyedPlace& a, const KeyedPlace& b) { return a.key < b.key; }));
}

}  // namespace sessile
