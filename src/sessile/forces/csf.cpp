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

  Vec3r operator()(int i) const {
    const Vec3r n = s.normal[i];
    const Real size = length(n);
    if (!(size > threshold)) return {};
    const Real around = s.near.sum(i, [&](auto j) { return s.m[j] / s.rho[j] * s.W.laplacian(s.to_fluid(i, j)); });
    const Real laplacian = s.m[i] / s.rho[i] * s.W.laplacian_at_zero() + around;
    return -sigma_over_rho0 / s.rho[i] * laplacian / size * n;
  }
};

}  // namespace

void Csf::add_acceleration(const StepView& s, Array3& acceleration) const {
  const CurvatureLaw law{s, static_cast<Real>(strength / s.units.rest_density), static_cast<Real>(threshold)};
  for_each(s.n, [&](int i) {
    const auto place = static_cast<std::size_t>(i);
    acceleration.set(place, acceleration[place] + law(i));
  });
}

double Csf::tension(const Units&) const { return strength; }

}  // namespace sessile
