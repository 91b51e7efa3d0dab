#pragma once

#include <filesystem>

#include "sessile/surface/surface_mesh.h"

namespace sessile::app {

/// Writes a level set named "surface" [m] of a closed mesh, three voxels to either side, whole or not at all.
/// `voxel` [m] is the edge of its voxels. Throws FileError.
void write_vdb(const std::filesystem::path& file, const SurfaceMesh& mesh, double voxel);

}  // namespace sessile::app
