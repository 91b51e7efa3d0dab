#include "sessile/surface/reconstruct.h"

#include <cmath>
#include <cstddef>

#include "sessile/core/error.h"
#include "sessile/core/parallel.h"
#include "sessile/kernels/cubic_spline.h"
#include "sessile/neighbors/neighbor_view.h"
#include "sessile/surface/carry.h"
#include "sessile/surface/cloud.h"
#include "sessile/surface/march.h"
#include "sessile/surface/normals.h"

namespace sessile {
namespace {

/// Blobs of the density over that of each particle: 1 at a lone one's centre.
Blobs density_blobs(const Cloud& cloud) {
  Blobs blobs;
  blobs.centers = cloud.position;
  blobs.blobs.resize(cloud.size());
  const CubicSpline W(cloud.search_radius, cloud.search_radius);
  const NeighborView near(cloud.near);
  for_each(cloud.size(), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    const Real others = near.sum(i, [&](int j) {
      return W.value(Separation<Real>(cloud.position[k] - cloud.position[static_cast<std::size_t>(j)]).r);
    });
    Blob& blob = blobs.blobs[k];
    blob.weight = static_cast<float>(W.at_zero() / (W.at_zero() + others));
    blob.xx = blob.yy = blob.zz = static_cast<float>(1 / (cloud.search_radius * cloud.search_radius));
    blob.reach.x = blob.reach.y = blob.reach.z = static_cast<float>(cloud.search_radius);
  });
  return blobs;
}

}  // namespace

SurfaceMesh reconstruct(const Snapshot& particles, double spacing, const SurfaceSettings& settings) {
  SurfaceMesh mesh;
  if (particles.size() > 0) {
    const auto& method = std::get<DensityField>(settings.method);
    const Cloud cloud(particles.points, spacing, 2 * method.smoothing_length);
    Blobs blobs = density_blobs(cloud);
    const BlockMap map(blobs, settings.cube_size * cloud.radius);
    mesh = march(map, spline_field(map, blobs, static_cast<float>(method.threshold)), cloud.unit);
    mesh.normals = vertex_normals(mesh);
    mesh.columns = carry_columns(particles, cloud, mesh);
  }
  mesh.time = particles.time;
  mesh.step = particles.step;
  return mesh;
}

}  // namespace sessile
