#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

/// How many of anything there may be. What refuses more stands where the things are made: sampling, setting up,
/// emitters, surfaces; everything else may count on these.
namespace sessile {

/// Most particles of a liquid, boundary particles of all solids, vertices of a surface, triangles of one: each is
/// numbered by an int32. The bound stays below 2^31 by more than a pack, because loops step over the last one by a
/// pack. Sizes, offsets and sums over them (2n, 3n, entries of neighbour lists, bytes) are 64 bits wide.
inline constexpr std::size_t most_indices = 2'000'000'000;

/// Most points in one cell, an edge of which is a support radius: the 27 cells around a point then hold less than 2^24,
/// and single precision, in which lists are masked, tells such counts apart.
inline constexpr std::size_t most_in_a_cell = (std::size_t{1} << 24) / 27;

static_assert(sizeof(std::size_t) == 8, "a machine of 64 bits");
static_assert(most_indices + 512 <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()),
              "a whole block past the last index is still an int32");

}  // namespace sessile
