#include "sessile/forces/viscosity.h"

#include "sessile/forces/pair_laws.h"
#include "sessile/walls/reaction.h"

namespace sessile {
namespace {

/// (x . grad W)/(r^2 + 0.01 h^2) [1/m^2], in units of 1/dx^3: the second derivative along the pair. Over a density, as
/// one division costs as much as the rest of a pair.
struct MorrisFactor {
  CubicSpline W;
  Real softening;  // 0.01 h^2 [m^2]

  explicit MorrisFactor(const StepView& s)
      : W(s.W), softening(static_cast<Real>(0.01 * s.units.support_radius * s.units.support_radius)) {}

  template <class T>
  T over(const T& density, const Separation<T>& pair) const {
    const T r2 = pair.r * pair.r;
    return r2 * W.slope_over_r(pair) / (density * (r2 + T(softening)));
  }
};

struct FluidLaw {
  StepView s;
  Real nu;  // mu / rho0 [m^2/s]
  MorrisFactor factor;

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& j) const {
    using T = LaneOf<I>;
    return T(2 * nu) * s.m[j] * factor.over(s.rho[i] * s.rho[j], s.to_fluid(i, j)) * (s.v[i] - s.v[j]);
  }
};

struct WallLaw {
  StepView s;
  MorrisFactor factor;

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& b) const {
    using T = LaneOf<I>;
    return T(Real(2)) * s.walls.viscosity[b] * s.walls.psi[b] * factor.over(T(s.rho[i]), s.to_wall(i, b)) *
           (s.v[i] - s.walls.v[b]);
  }
};

}  // namespace

void add_viscosity(const StepView& view, double viscosity, Array3& acceleration) {
  StepView s = view;
  s.v = s.paired(s.v);
  const MorrisFactor factor(s);
  const auto nu = static_cast<Real>(viscosity / s.units.rest_density);
  add_sums(s, FluidLaw{s, nu, factor}, WallLaw{s, factor}, acceleration);
}

void add_viscosity_reaction(const StepView& view, const Walls& walls, std::span<SolidForce> forces) {
  add_reaction(view, walls, WallLaw{view, MorrisFactor(view)}, forces);
}

}  // namespace sessile
