#include "sessile/pressure/pressure_force.h"

#include "sessile/core/parallel.h"
#include "sessile/neighbors/step_view.h"
#include "sessile/walls/reaction.h"

namespace sessile {
namespace {

struct PressureLaw {
  StepView s;
  View1 stress;  // p_i/rho_i^2

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& j) const {
    const auto pair = s.to_fluid(i, j);
    return -s.m[j] * (stress[i] + stress[j]) * s.W.gradient(pair);
  }
};

struct WallPressureLaw {
  StepView s;
  View1 stress;

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& b) const {
    const auto pair = s.to_wall(i, b);
    return -stress[i] * s.walls.psi[b] * s.W.gradient(pair);
  }
};

struct PressureKernel {
  PressureLaw fluid;
  WallPressureLaw wall;
  Out3 a;

  template <ParticleIndex I>
  void operator()(I i) const {
    a.set(i, fluid.s.near.sum(i, [&](auto j) { return fluid(i, j); }) +
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
  s.for_each_particle(PressureKernel{{s, view(stress)}, {s, view(stress)}, out(acceleration)});
}

void add_pressure_reaction(const StepView& s, const Array<Real>& stress, const Walls& walls,
                           std::span<SolidForce> forces) {
  add_reaction(s, walls, WallPressureLaw{s, view(stress)}, forces);
}

}  // namespace sessile
