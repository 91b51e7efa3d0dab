#pragma once

#include <string>
#include <vector>

#include "sessile/scene/mesh.h"
#include "sessile/scene/scene.h"

namespace sessile {

/// A solid as triangles in the world, to be looked at.
struct SolidMesh {
  std::string label;  ///< as in stats.csv: the solid's, or solid0, solid1 ...
  TriangleMesh mesh;  ///< vertices in the world [m]; a plate is one flat sheet, a container's faces look inwards
};

/// Every solid of the scene, in its order; closed faces of the domain are not among them. Round shapes get enough
/// corners to look round. Throws FileError or SceneError of a mesh file.
std::vector<SolidMesh> solid_meshes(const Scene& scene);

}  // namespace sessile
