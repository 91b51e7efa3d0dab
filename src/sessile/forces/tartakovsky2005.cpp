#include "sessile/forces/tartakovsky2005.h"

#include <cmath>
#include <numbers>

#include "sessile/forces/pair_laws.h"
#include "sessile/walls/reaction.h"

namespace sessile {
namespace {

constexpr double k = 1.5 * std::numbers::pi;

/// cos(3 pi r/(2h)) x_ij/r. Cut off at h: a pack's cosine takes another way for all its lanes when one of them is large
/// or not finite, and in the lanes past the last particle anything may stand. Bits would then depend on old memory.
struct PairForce {
  Real k_over_h;  // [1/m]

  explicit PairForce(const StepView& s) : k_over_h(static_cast<Real>(k / s.units.support_radius)) {}

  template <class T>
  Vec3<T> operator()(const Separation<T>& pair) const {
    return cos(min(T(k_over_h) * pair.r, T(static_cast<Real>(k)))) * unit_vector(pair);
  }
};

struct PairwiseTensionLaw {
  StepView s;
  Real strength;  // s/(rho0 dx^3) [m/s^2]
  PairForce force;

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& j) const {
    using T = LaneOf<I>;
    return T(strength) / s.m[i] * force(s.to_fluid(i, j));
  }
};

struct PairwiseAdhesionLaw {
  StepView s;
  Real strength;  // s_w/(rho0 dx^3) [m/s^2]
  PairForce force;

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& b) const {
    using T = LaneOf<I>;
    return T(strength) / s.m[i] * s.walls.adhesion[b] * s.walls.psi[b] * force(s.to_wall(i, b));
  }
};

PairwiseAdhesionLaw adhesion_law(const Tartakovsky2005& model, const StepView& s) {
  return {s, static_cast<Real>(model.adhesion / s.units.particle_mass()), PairForce(s)};
}

}  // namespace

void Tartakovsky2005::add_acceleration(const StepView& s, Array3& acceleration) const {
  const PairwiseTensionLaw tension_law{s, static_cast<Real>(strength / s.units.particle_mass()), PairForce(s)};
  add_sums(s, tension_law, adhesion_law(*this, s), acceleration);
}

void Tartakovsky2005::add_reaction(const StepView& s, const Walls& walls, std::span<SolidForce> forces) const {
  sessile::add_reaction(s, walls, adhesion_law(*this, s), forces);
}

double Tartakovsky2005::tension(const Units& units) const {
  const double ratio = units.support_radius / units.spacing;
  const double moment = 1 / k - 12 / std::pow(k, 3) + 24 / std::pow(k, 5);
  return std::numbers::pi / 8 * strength / units.spacing * std::pow(ratio, 5) * moment;
}

}  // namespace sessile
