#include "sessile/forces/becker2007.h"

#include <cmath>

#include "sessile/forces/pair_laws.h"

namespace sessile {
namespace {

/// -(kappa/m_i) m_j x_ij W( max(r, dx) )
struct BeckerTensionLaw {
  StepView s;
  Real kappa;  // over dx^3 [1/s^2]
  Real dx;

  template <ParticleIndex I, NeighborIndex J>
  auto operator()(I i, const J& j) const {
    using T = LaneOf<I>;
    const auto pair = s.to_fluid(i, j);
    return T(-kappa) / s.m[i] * s.m[j] * s.W.value(max(pair.r, T(dx))) * pair.d;
  }
};

/// int_0^1 w(max(q, a)) q^5 dq = int_a^1 -w'(q) q^6/6 dq of the cubic spline w
double fifth_moment(double a) {
  const auto outer = [](double q) { return std::pow(q, 7) / 7 - std::pow(q, 8) / 4 + std::pow(q, 9) / 9; };
  const auto inner = [](double q) { return std::pow(q, 8) / 4 - std::pow(q, 9) / 3; };
  if (a >= 1) return 0;
  return a < 0.5 ? outer(1) - outer(0.5) + inner(0.5) - inner(a) : outer(1) - outer(a);
}

}  // namespace

void Becker2007::add_acceleration(const StepView& s, Array3& acceleration) const {
  const double dx = s.units.spacing;
  add_sums(s, BeckerTensionLaw{s, static_cast<Real>(strength / (dx * dx * dx)), static_cast<Real>(dx)}, acceleration);
}

double Becker2007::tension(const Units& units) const {
  const double ratio = units.support_radius / units.spacing;
  return units.rest_density * strength * ratio * ratio * ratio * fifth_moment(1 / ratio);
}

}  // namespace sessile
