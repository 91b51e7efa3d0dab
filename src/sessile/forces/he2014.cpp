#include "sessile/forces/he2014.h"

#include "sessile/forces/pair_laws.h"
#include "sessile/walls/reaction.h"

namespace sessile {
namespace {

/// c_i
struct Colour {
  StepView s;

  template <ParticleIndex I>
  auto operator()(I i) const {
    return s.m[i] / s.rho[i] * s.W.at_zero() + s.near.sum(i, [&](auto j) {
      return s.m[j] / s.rho[j] * s.W.value(s.to_fluid(i, j).r);
    }) + s.near_walls.sum(i, [&](auto b) { return s.walls.psi[b] * s.W.value(s.to_wall(i, b).r); });
  }
};

/// h^2 |grad c_i|^2
struct Steepness {
  StepView s;
  Real h;
  View1 c;

  template <ParticleIndex I>
  auto operator()(I i) const {
    const auto fluid = s.near.sum(i, [&](auto j) { return s.m[j] / s.rho[j] * c[j] * s.W.gradient(s.to_fluid(i, j)); });
    const auto walls = s.near_walls.sum(i, [&](auto b) { return s.walls.psi[b] * s.W.gradient(s.to_wall(i, b)); });
    return squared_length(LaneOf<I>(h) / c[i] * fluid + h * walls);
  }
};

/// (1/rho_i) V_j ( (kappa/4) (|grad c_i|^2 + |grad c_j|^2) + p_air ) grad W_ij
struct HeTensionLaw {
  StepView s;
  Real kappa;  // kappa/(4 h^2 rho0) [m^2/s^2]
  Real air;    // p_air/rho0 [m^2/s^2]
  View1 steepness;

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& j) const {
    using T = LaneOf<I>;
    const T stress = T(kappa) * (steepness[i] + steepness[j]) + T(air);
    return T(Real(1)) / s.rho[i] * s.m[j] / s.rho[j] * stress * s.W.gradient(s.to_fluid(i, j));
  }
};

/// (1/rho_i) V_b p_air grad W_ib
struct AirLaw {
  StepView s;
  Real air;  // p_air/rho0 [m^2/s^2]

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& b) const {
    using T = LaneOf<I>;
    return T(air) / s.rho[i] * s.walls.psi[b] * s.W.gradient(s.to_wall(i, b));
  }
};

AirLaw air_law(const He2014& model, const StepView& s) {
  return {s, static_cast<Real>(model.air_pressure / s.units.rest_density)};
}

/// law(i) of every particle.
template <class Law>
Array<Real> of_each(const StepView& s, const Law& law) {
  Array<Real> all(s.n);
  const Out1 each = out(all);
  s.for_each_particle([&](auto i) { each.set(i, law(i)); });
  return all;
}

}  // namespace

void He2014::add_acceleration(const StepView& s, Array3& acceleration) const {
  const double h = s.units.support_radius;
  const Array<Real> colour = of_each(s, Colour{s});
  const Array<Real> steepness = of_each(s, Steepness{s, static_cast<Real>(h), view(colour)});
  const AirLaw air = air_law(*this, s);
  const auto kappa = static_cast<Real>(strength / (4 * h * h * s.units.rest_density));
  add_sums(s, HeTensionLaw{s, kappa, air.air, view(steepness)}, air, acceleration);
}

void He2014::add_reaction(const StepView& s, const Walls& walls, std::span<SolidForce> forces) const {
  sessile::add_reaction(s, walls, air_law(*this, s), forces);
}

double He2014::tension(const Units& units) const { return 0.08416 * strength / units.support_radius; }

}  // namespace sessile
