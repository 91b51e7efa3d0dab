#pragma once

#include "sessile/output/snapshot.h"
#include "sessile/scene/surface_settings.h"
#include "sessile/surface/surface_mesh.h"

namespace sessile {

/// The surface of the liquid that the particles stand for. `spacing` is the scene's particle spacing [m].
/// The mesh carries every column of the particles: vectors and numbers averaged, whole numbers of the nearest particle.
/// No particles, no surface. The same bits for any number of threads. Throws Error when the grid would be too fine for
/// its numbers.
SurfaceMesh reconstruct(const Snapshot& particles, double spacing, const SurfaceSettings& settings);

}  // namespace sessile
