#include "sessile/walls/walls.h"

#include "sessile/core/views.h"
#include "sessile/kernels/cubic_spline.h"
#include "sessile/neighbors/neighbor_view.h"
#include "sessile/scene/lattice.h"
#include "sessile/scene/sampling.h"

namespace sessile {
namespace {

template <class T>
void put_in_order(Array<T>& array, std::span<const std::int32_t> order) {
  const Array<T> old = array;
  for (std::size_t k = 0; k < order.size(); ++k) array[k] = old[static_cast<std::size_t>(order[k])];
}

}  // namespace

Walls make_walls(const std::vector<Solid>& solids, const Scene& scene, const GridShape& shape, const Space& space,
                 Grid& grid) {
  Walls walls;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    const Solid& solid = solids[k];
    const std::vector<Vec3d> places = sample_surface(solid, scene.spacing);
    check_count(static_cast<double>(walls.size() + places.size()), "the scene's solids");
    for (const Vec3d& place : places) {
      walls.position.push_back(vec_cast<Real>(place));
      walls.solid.push_back(static_cast<std::int32_t>(k));
    }
    walls.labels.push_back(solid.label.empty() ? "solid" + std::to_string(k) : solid.label);
    walls.centres.push_back(solid.placement.position);
    walls.forces.emplace_back();
  }
  const std::size_t n = walls.size();
  walls.velocity.assign(n, {});

  grid.build(walls.position, shape);
  for (auto* array : {&walls.position.x, &walls.position.y, &walls.position.z}) put_in_order(*array, grid.order());
  put_in_order(walls.solid, grid.order());
  set_materials(solids, scene.fluid, walls);

  const CubicSpline W(scene.support_radius(), scene.spacing);
  const View3 x{walls.position.x.data(), walls.position.y.data(), walls.position.z.data()};
  walls.psi.resize(n);
  const Out1 psi{walls.psi.data()};
  const auto h = static_cast<Real>(scene.support_radius());
  NeighborList list;
  // Where samples are much closer than particles each has thousands of others near it: lists of all would fill memory.
  for (const PlaceRange& part : parts_of(n, grid.fullest_cell())) {
    list.build({walls.position, grid}, {walls.position, grid}, space, h, part);
    const NeighborView near(list);
    for_each_group(list.size(), [&](Group k) {
      const Group b{part.begin + k.first};
      const Lanes others = near.sum(k, [&](auto c) { return W.value(length(space.displacement(x[b], x[c]))); });
      psi.set(b, Lanes(Real(1)) / (Lanes(W.at_zero()) + others));
    });
  }
  return walls;
}

void set_materials(const std::vector<Solid>& solids, const Fluid& fluid, Walls& walls) {
  walls.adhesion.resize(walls.size());
  walls.viscosity.resize(walls.size());
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const Solid& solid = solids[static_cast<std::size_t>(walls.solid[k])];
    walls.adhesion[k] = static_cast<Real>(solid.adhesion);
    walls.viscosity[k] = static_cast<Real>(solid.viscosity.value_or(fluid.viscosity) / fluid.rest_density);
  }
}

std::size_t Walls::bytes() const { return size() * (9 * sizeof(Real) + sizeof(std::int32_t)); }

}  // namespace sessile
