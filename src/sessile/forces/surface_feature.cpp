#include "sessile/forces/surface_feature.h"

#include "sessile/forces/pair_laws.h"
#include "sessile/kernels/adhesion.h"
#include "sessile/kernels/cohesion.h"
#include "sessile/walls/reaction.h"

namespace sessile {
namespace {

/// e_ij of (14) and (22): the displacement [m], or its unit vector; 0 for coincident particles.
template <class T>
Vec3<T> pair_direction(Direction reading, const Separation<T>& pair) {
  return reading == Direction::unit ? unit_vector(pair) : pair.d;
}

/// -K_ij ( alpha m_j d(r) e_ij + beta (n_i - n_j) ), K_ij = 2 rho0^2/(rho_i^2 + rho_j^2)   (14, 18, 20, 21)
/// With unequal masses the area term takes their mean over m_i, so that it stays antisymmetric. Coincident
/// particles exert nothing on each other.
struct FeatureTensionLaw {
  StepView s;
  CohesionSpline cohesion;
  Real alpha_rho0;
  Real beta;
  Direction reading;

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& j) const {
    using T = LaneOf<I>;
    const auto pair = s.to_fluid(i, j);
    const T mi = s.m[i], mj = s.m[j], rho_i = s.rho[i], rho_j = s.rho[j];
    const T half_K_over_mass = T(Real(1)) / (mi * (rho_i * rho_i + rho_j * rho_j));
    const T pull = T(2 * alpha_rho0) * mi * mj * cohesion.value(pair.r);
    return -half_K_over_mass *
           (pull * pair_direction(reading, pair) + T(beta) * (mi + mj) * normal_difference(s, i, j, pair));
  }
};

/// -eta psi_b y(r) e_ib, times the solid's own factor   (22, 23)
struct FeatureAdhesionLaw {
  StepView s;
  AdhesionSpline adhesion;
  Real eta_rho0;
  Direction reading;

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& b) const {
    using T = LaneOf<I>;
    const auto pair = s.to_wall(i, b);
    return T(-eta_rho0) * s.walls.adhesion[b] * s.walls.psi[b] * adhesion.value(pair.r) * pair_direction(reading, pair);
  }
};

FeatureAdhesionLaw adhesion_law(const SurfaceFeature& model, const StepView& s) {
  return {s, AdhesionSpline(s.units.support_radius, s.units.spacing),
          static_cast<Real>(model.adhesion * s.units.rest_density), model.direction};
}

}  // namespace

void SurfaceFeature::add_acceleration(const StepView& view, Array3& acceleration) const {
  StepView s = view;
  s.normal = s.paired(s.normal);
  const FeatureTensionLaw tension_law{s, CohesionSpline(s.units.support_radius, s.units.spacing),
                                      static_cast<Real>(cohesion * s.units.rest_density),
                                      static_cast<Real>(area_minimisation), direction};
  add_sums(s, tension_law, adhesion_law(*this, s), acceleration);
}

void SurfaceFeature::add_reaction(const StepView& s, const Walls& walls, std::span<SolidForce> forces) const {
  sessile::add_reaction(s, walls, adhesion_law(*this, s), forces);
}

double SurfaceFeature::tension(const Units& units) const {
  const double h = units.support_radius;
  const double unit = cohesion * units.rest_density * units.rest_density * h * h;
  return direction == Direction::unit ? 21.0 / 7040 * unit : 271.0 / 135168 * unit * h;
}

}  // namespace sessile
