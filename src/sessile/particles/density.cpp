#include "sessile/particles/density.h"

#include "sessile/neighbors/step_view.h"

namespace sessile {
namespace {

struct DensityKernel {
  StepView s;
  Out1 rho;

  template <ParticleIndex I>
  void operator()(I i) const {
    const auto fluid = s.near.sum(i, [&](auto j) { return s.m[j] * s.W.value(s.to_fluid(i, j).r); });
    const auto walls = s.near_walls.sum(i, [&](auto b) { return s.walls.psi[b] * s.W.value(s.to_wall(i, b).r); });
    rho.set(i, s.m[i] * s.W.at_zero() + fluid + walls);
  }
};

struct NormalKernel {
  StepView s;
  Real h;
  Out3 n;

  template <ParticleIndex I>
  void operator()(I i) const {
    n.set(i, h * s.near.sum(i, [&](auto j) { return s.m[j] / s.rho[j] * s.W.gradient(s.to_fluid(i, j)); }));
  }
};

}  // namespace

void compute_density(const StepView& s, Array<Real>& density) {
  density.resize(s.n);
  s.for_each_particle(DensityKernel{s, out(density)});
}

void compute_normals(const StepView& s, Array3& normal) {
  normal.resize(s.n);
  s.for_each_particle(NormalKernel{s, static_cast<Real>(s.units.support_radius), out(normal)});
}

}  // namespace sessile
