#pragma once

#include <cstdint>

#include "sessile/core/array.h"

namespace sessile {

/// A sort key and the place it came from.
struct KeyedPlace {
  std::uint64_t key;
  std::int32_t place;
};

/// Sorts by the lowest `bits` bits of the keys; equal keys keep their order, so the result is one and the same for any
/// number of threads. Least significant digit first, on all threads. `scratch` is memory to reuse.
void radix_sort(Array<KeyedPlace>& items, Array<KeyedPlace>& scratch, int bits);

}  // namespace sessile
