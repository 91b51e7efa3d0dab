#include "sessile/forces/csf.h"

#include "sessile/core/parallel.h"
#include "sessile/neighbors/step_view.h"

namespace sessile {
namespace {

/// -(sigma/rho_i) (lap c)_i n_i/|n_i|, where h |n_i| exceeds the threshold
struct CurvatureLaw {
  StepView s;
  Real sigma_over_rho0;  // [m^3/s^2]
  Real threshold;

  template <ParticleIndex I>
  Vec3<LaneOf<I>> operator()(I i) const {
    using T = LaneOf<I>;
    const auto n = s.normal[i];
    const T size = length(n);
    const auto at_surface = size > T(threshold);
    if (!any(at_surface)) return {T(Real(0)), T(Real(0)), T(Real(0))};
    const T around = s.near.sum(i, [&](auto j) { return s.m[j] / s.rho[j] * s.W.laplacian(s.to_fluid(i, j)); });
    const T laplacian = s.m[i] / s.rho[i] * s.W.laplacian_at_zero() + around;
    return select(at_surface, T(-sigma_over_rho0) / s.rho[i] * laplacian / size, T(Real(0))) * n;
  }
};

}  // namespace

void Csf::add_acceleration(const StepView& s, Array3& acceleration) const {
  const CurvatureLaw law{s, static_cast<Real>(strength / s.units.rest_density), static_cast<Real>(threshold)};
  const Out3 a = out(acceleration);
  s.for_each_particle([&](auto i) { a.add(i, law(i)); });
}

double Csf::tension(const Units&) const { return strength; }

}  // namespace sessile
