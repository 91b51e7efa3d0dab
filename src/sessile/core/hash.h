#pragma once

#define XXH_INLINE_ALL  // NOLINT(readability-identifier-naming): a word of xxhash: its header is all it takes then
#include <xxhash.h>

#include <cstddef>
#include <cstdint>

namespace sessile {

/// XXH3 of some bytes; with the hash of others as `seed`, of those before these.
inline std::uint64_t hash(const void* bytes, std::size_t size, std::uint64_t seed = 0) {
  return XXH3_64bits_withSeed(bytes, size, seed);
}

}  // namespace sessile
