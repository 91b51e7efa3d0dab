#include "sessile/forces/akinci2013.h"

#include "sessile/forces/pair_laws.h"
#include "sessile/kernels/akinci_adhesion.h"
#include "sessile/kernels/cohesion.h"
#include "sessile/walls/reaction.h"

namespace sessile {
namespace {

/// -gamma K_ij ( m_j C(r) x_ij/r + n_i - n_j ),  K_ij = 2 rho0/(rho_i + rho_j)
struct TensionLaw {
  StepView s;
  CohesionSpline cohesion;
  Real gamma;
  Real rho0;

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& j) const {
    using T = LaneOf<I>;
    const auto pair = s.to_fluid(i, j);
    const T K = T(Real(2)) / (s.rho[i] + s.rho[j]);
    const T pull = T(rho0) * s.m[j] * cohesion.value(pair.r);
    return T(-gamma) * K * (pull * unit_vector(pair) + normal_difference(s, i, j, pair));
  }
};

/// -beta psi_b A(r) x_ib/r, times the solid's own factor
struct AdhesionLaw {
  StepView s;
  AkinciAdhesionSpline adhesion;
  Real beta_rho0;

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& b) const {
    using T = LaneOf<I>;
    const auto pair = s.to_wall(i, b);
    return T(-beta_rho0) * s.walls.adhesion[b] * s.walls.psi[b] * adhesion.value(pair.r) * unit_vector(pair);
  }
};

AdhesionLaw adhesion_law(const Akinci2013& model, const StepView& s) {
  return {s, AkinciAdhesionSpline(s.units.support_radius, s.units.spacing),
          static_cast<Real>(model.adhesion * s.units.rest_density)};
}

}  // namespace

void Akinci2013::add_acceleration(const StepView& view, Array3& acceleration) const {
  StepView s = view;
  s.normal = s.paired(s.normal);
  const TensionLaw tension_law{s, CohesionSpline(s.units.support_radius, s.units.spacing), static_cast<Real>(strength),
                               static_cast<Real>(s.units.rest_density)};
  add_sums(s, tension_law, adhesion_law(*this, s), acceleration);
}

void Akinci2013::add_reaction(const StepView& s, const Walls& walls, std::span<SolidForce> forces) const {
  sessile::add_reaction(s, walls, adhesion_law(*this, s), forces);
}

double Akinci2013::tension(const Units& units) const {
  const double h = units.support_radius;
  return 21.0 / 7040 * strength * units.rest_density * units.rest_density * h * h;
}

}  // namespace sessile
