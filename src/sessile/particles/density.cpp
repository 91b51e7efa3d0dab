#include "sessile/particles/density.h"

#include "sessile/core/parallel.h"
#include "sessile/neighbors/step_view.h"

namespace sessile {
namespace {

struct DensityKernel {
  StepView s;
  Real* rho;

  void operator()(int i) const {
    const Real fluid = s.near.sum(i, [&](auto j) { return s.m[j] * s.W.value(s.to_fluid(i, j).r); });
    const Real walls = s.near_walls.sum(i, [&](auto b) { return s.walls.psi[b] * s.W.value(s.to_wall(i, b).r); });
    rho[i] = s.m[i] * s.W.at_zero() + fluid + walls;
  }
};

struct NormalKernel {
  StepView s;
  Real h;
  Array3& n;

  void operator()(int i) const {
    n.set(static_cast<std::size_t>(i),
          h * s.near.sum(i, [&](auto j) { return s.m[j] / s.rho[j] * s.W.gradient(s.to_fluid(i, j)); }));
  }
};

}  // namespace

void compute_density(const StepView& view, Array<Real>& density) {
  density.resize(view.n);
  for_each(view.n, DensityKernel{view, density.data()});
}

void compute_normals(const StepView& view, Array3& normal) {
  normal.resize(view.n);
  for_each(view.n, NormalKernel{view, static_cast<Real>(view.units.support_radius), normal});
}

}  // namespace sessile
