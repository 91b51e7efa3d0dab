#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sessile/core/array.h"
#include "sessile/scene/scene.h"

namespace sessile {

/// What the liquid does to one solid: the exact opposite of what the solid did to the liquid in the last step.
struct SolidForce {
  Vec3d force{};   ///< [N]
  Vec3d torque{};  ///< [N m] about the solid's placement position
};

/// The solids' boundary particles (Akinci et al. 2012), all solids in one set, sorted by cell.
///   V_b = 1 / sum_b' W_bb',  psi_b = rho0 V_b
struct Walls {
  Array3 position;            ///< [m]
  Array3 velocity;            ///< [m/s]
  Array<Real> psi;            ///< psi_b in units of rho0 dx^3
  Array<Real> adhesion;       ///< factor of the sample's solid on adhesion
  Array<Real> viscosity;      ///< mu_wall / rho0 [m^2/s] of the sample's solid
  Array<std::int32_t> solid;  ///< index of the solid a sample belongs to

  std::vector<std::string> labels;  ///< one per solid
  std::vector<Vec3d> centres;       ///< one per solid: the point its torque is about [m]
  std::vector<SolidForce> forces;   ///< one per solid

  std::size_t size() const { return solid.size(); }
  std::size_t bytes() const;
};

class Grid;
struct GridShape;
struct Space;

/// Samples the solids and gives each boundary particle its psi from all samples within the support radius (Akinci
/// 2012). Fills `grid` with them: they are in its order. Throws SceneError or FileError when a solid cannot be sampled.
Walls make_walls(const std::vector<Solid>& solids, const Scene& scene, const GridShape& shape, const Space& space,
                 Grid& grid);

/// Gives each sample the adhesion and the viscosity of its solid; `solids` are those the walls were made of.
void set_materials(const std::vector<Solid>& solids, const Fluid& fluid, Walls& walls);

}  // namespace sessile
