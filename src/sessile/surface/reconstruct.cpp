#include "sessile/surface/reconstruct.h"

#include <variant>

#include "sessile/surface/blobs_of.h"
#include "sessile/surface/carry.h"
#include "sessile/surface/decimate.h"
#include "sessile/surface/march.h"
#include "sessile/surface/smooth.h"

namespace sessile {
namespace {

BlockField field_of(const DensityField& method, const BlockMap& map, const Blobs& blobs, double) {
  return density_field(map, blobs, static_cast<float>(method.threshold));
}

BlockField field_of(const AnisotropicKernels& method, const BlockMap& map, const Blobs& blobs, double) {
  return density_field(map, blobs, static_cast<float>(method.threshold));
}

BlockField field_of(const MeanDistance& method, const BlockMap& map, const Blobs& blobs, double radius) {
  return mean_distance_field(map, blobs, static_cast<float>(method.radius * radius / map.cube()));
}

}  // namespace

SurfaceMesh reconstruct(const Snapshot& particles, double spacing, const SurfaceSettings& settings) {
  SurfaceMesh mesh;
  if (particles.size() > 0) {
    const double reach = std::visit([](const auto& method) { return 2 * method.smoothing_length; }, settings.method);
    const Cloud cloud(particles.points, spacing, reach);
    Blobs blobs = std::visit([&](const auto& method) { return blobs_of(method, cloud); }, settings.method);
    const BlockMap map(blobs, settings.cube_size * cloud.radius);
    mesh = march(
        map,
        std::visit([&](const auto& method) { return field_of(method, map, blobs, cloud.radius); }, settings.method),
        cloud.unit);
    smooth(mesh, settings.smoothing, settings.normal_smoothing);
    decimate(mesh, settings.decimation, settings.decimation_error * spacing / 2);
    mesh.columns = carry_columns(particles, cloud, mesh);
  }
  mesh.time = particles.time;
  mesh.step = particles.step;
  return mesh;
}

}  // namespace sessile
