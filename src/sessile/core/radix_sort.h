#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sessile/core/array.h"

namespace sessile {

/// A sort key and the place it came from.
struct KeyedPlace {
  std::uint64_t key;
  std::int32_t place;
};

/// Bits of a key that are sorted by at once, and the counts of each of their values.
inline constexpr int digit_bits = 10;
using DigitCounts = std::array<std::int32_t, std::size_t{1} << digit_bits>;

/// Turns the counts of consecutive chunks of items into the place of the first item of each, all digits in order.
void counts_to_starts(std::span<DigitCounts> chunks);

/// Sorts by the lowest `bits` bits of the keys; equal keys keep their order, so the result is one and the same for any
/// number of threads. Least significant digit first, on all threads. `scratch` is memory to reuse.
void radix_sort(Array<KeyedPlace>& items, Array<KeyedPlace>& scratch, int bits);

}  // namespace sessile
