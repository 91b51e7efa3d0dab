#include "sessile/pressure/pressure_force.h"

#include "sessile/core/parallel.h"
#include "sessile/neighbors/step_view.h"
#include "sessile/walls/reaction.h"

namespace sessile {
namespace {

struct FluidLaw {
  StepView s;
  View1 stress;  // p_i/rho_i^2

  template <NeighborIndex J>
  auto operator()(int i, const J& j) const {
    using T = LaneOf<J>;
    const auto pair = s.to_fluid(i, j);
    return -s.m[j] * (T(stress[i]) + stress[j]) * s.W.gradient(pair);
  }
};

struct WallLaw {
  StepView s;
  View1 stress;

  template <NeighborIndex J>
  auto operator()(int i, const J& b) const {
    using T = LaneOf<J>;
    const auto pair = s.to_wall(i, b);
    return T(-stress[i]) * s.walls.psi[b] * s.W.gradient(pair);
  }
};

struct PressureKernel {
  FluidLaw fluid;
  WallLaw wall;
  Array3& a;

  void operator()(int i) const {
    a.set(static_cast<std::size_t>(i), fluid.s.near.sum(i, [&](auto j) { return fluid(i, j); }) +
                                           fluid.s.near_walls.sum(i, [&](auto b) { return wall(i, b); }));
  }
};

}  // namespace

void pressure_acceleration(const StepView& s, const Array<Real>& pressure, Array<Real>& stress, Array3& acceleration) {
  stress.resize(s.n);
  acceleration.resize(s.n);
  for_each(s.n, [&](int i) {
    stress[static_cast<std::size_t>(i)] = pressure[static_cast<std::size_t>(i)] / (s.rho[i] * s.rho[i]);
  });
  for_each(s.n, PressureKernel{{s, view(stress)}, {s, view(stress)}, acceleration});
}

void add_pressure_reaction(const StepView& s, const Array<Real>& stress, const Walls& walls,
                           std::span<SolidForce> forces) {
  add_reaction(s, walls, WallLaw{s, view(stress)}, forces);
}

}  // namespace sessile
