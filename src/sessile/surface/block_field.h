#pragma once

#include <array>

#include "sessile/core/array.h"
#include "sessile/surface/block_map.h"

/// A field on the points of a BlockMap. Internal.
namespace sessile {

/// The field's values in a block, x fastest. Above 0 is inside.
struct alignas(64) BlockValues {
  std::array<float, block_points> at;
};

/// Values on all blocks, and what the field is beyond them.
struct BlockField {
  Array<BlockValues> blocks;
};

/// Sum of the blobs' cubic splines, less the threshold:  f = sum_j w_j (6q^3 - 6q^2 + 1 or 2(1-q)^3) - T.
BlockField density_field(const BlockMap& map, const Blobs& blobs, float threshold);

/// How much nearer than `radius` the mean of the blobs' centres is, in points:  f = r - |x - sum_j k_j x_j / sum_j
/// k_j|, k = (1 - q^2)^3.
BlockField mean_distance_field(const BlockMap& map, const Blobs& blobs, float radius);

}  // namespace sessile
