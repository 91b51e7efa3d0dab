#include "sessile/surface/blobs_of.h"

#include <cmath>
#include <cstddef>

#include "sessile/core/parallel.h"

namespace sessile {
namespace {

Blobs round_blobs(const Cloud& cloud) {
  Blobs blobs;
  blobs.centers = cloud.position;
  Blob blob;
  blob.xx = blob.yy = blob.zz = static_cast<float>(1 / (cloud.search_radius * cloud.search_radius));
  blob.reach.x = blob.reach.y = blob.reach.z = static_cast<float>(cloud.search_radius);
  blobs.blobs.assign(cloud.size(), blob);
  return blobs;
}

}  // namespace

Blobs blobs_of(const DensityField&, const Cloud& cloud) {
  Blobs blobs = round_blobs(cloud);
  for_each(cloud.size(), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3d at = vec_cast<double>(cloud.position[k]);
    double density = 1;
    for (const std::int32_t j : cloud.near[k]) {
      density +=
          blob_kernel(length(vec_cast<double>(cloud.position[static_cast<std::size_t>(j)]) - at) / cloud.search_radius);
    }
    blobs.blobs[k].weight = static_cast<float>(1 / density);
  });
  return blobs;
}

Blobs blobs_of(const MeanDistance&, const Cloud& cloud) { return round_blobs(cloud); }

}  // namespace sessile
