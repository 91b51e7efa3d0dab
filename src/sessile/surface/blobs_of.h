#pragma once

#include "sessile/scene/surface_settings.h"
#include "sessile/surface/blobs.h"
#include "sessile/surface/cloud.h"

/// What each method makes of the particles. Internal.
namespace sessile {

Blobs blobs_of(const DensityField& method, const Cloud& cloud);
Blobs blobs_of(const MeanDistance& method, const Cloud& cloud);
Blobs blobs_of(const AnisotropicKernels& method, const Cloud& cloud);

/// The kernel of all blobs: 6q^3 - 6q^2 + 1 or 2(1-q)^3, 1 in the middle and 0 from q = 1 on.
inline double blob_kernel(double q) {
  const double outer = q < 1 ? 1 - q : 0, inner = q < 0.5 ? 0.5 - q : 0;
  return 2 * outer * outer * outer - 8 * inner * inner * inner;
}

}  // namespace sessile
