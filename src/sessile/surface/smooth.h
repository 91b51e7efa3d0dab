#pragma once

#include "sessile/surface/surface_mesh.h"

namespace sessile {

/// Moves every vertex towards the mean of its neighbours and, a little farther, back again, as often as said (Taubin, A
/// signal processing approach to fair surface design, 1995): what is as short as the triangles goes, volumes stay.
/// Then normals: means of the triangles around each vertex by area, `normal_turns` times averaged with the neighbours'.
void smooth(SurfaceMesh& mesh, int turns, int normal_turns);

}  // namespace sessile
