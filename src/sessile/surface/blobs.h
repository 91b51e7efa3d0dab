#pragma once

#include <vector>

#include "sessile/core/array.h"

namespace sessile {

/// What one particle adds to the field around its centre: weight * kernel(q), q^2 = d A d for the displacement d.
struct Blob {
  float weight = 1;
  float xx = 1, xy = 0, xz = 0, yy = 1, yz = 0, zz = 1;  ///< of the symmetric matrix A [1/length^2]
  Vec3<float> reach;                                     ///< half of the box outside which q > 1
};

/// Particles as the field sees them, in any unit of length.
struct Blobs {
  Array3 centers;
  std::vector<Blob> blobs;

  std::size_t size() const { return blobs.size(); }
};

}  // namespace sessile
