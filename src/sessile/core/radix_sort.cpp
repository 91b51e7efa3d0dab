#include "sessile/core/radix_sort.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace sessile {

void radix_sort(Array<KeyedPlace>& items, Array<KeyedPlace>& scratch, int bits) {
  constexpr std::ptrdiff_t chunk = 1 << 15;
  constexpr int digit_bits = 10;
  constexpr std::size_t digits = std::size_t{1} << digit_bits;
  const auto n = static_cast<std::ptrdiff_t>(items.size());
  const std::ptrdiff_t chunks = (n + chunk - 1) / chunk;
  std::vector<std::array<std::int32_t, digits>> counts(static_cast<std::size_t>(chunks));
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
    std::int32_t start = 0;
    for (std::size_t d = 0; d < digits; ++d) {
      for (auto& count : counts) start += std::exchange(count[d], start);
    }
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
}

}  // namespace sessile
