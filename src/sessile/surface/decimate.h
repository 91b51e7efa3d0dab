#pragma once

#include "sessile/surface/surface_mesh.h"

namespace sessile {

/// Takes up to `share` of the triangles out of every connected piece of a surface without columns, as long as it moves
/// by no more than about `error` [m] (root mean square over the triangles that met in a vertex): edges collapse to one
/// of their ends, the cheapest first (Garland and Heckbert, Surface simplification using quadric error metrics, 1997).
/// Vertices that stay keep their place, normal and order. A piece stays closed, keeps its holes and its volume within
/// 2 %: where it would not, less is taken out of it, at last nothing. The same bits for any number of threads.
void decimate(SurfaceMesh& mesh, double share, double error);

}  // namespace sessile
