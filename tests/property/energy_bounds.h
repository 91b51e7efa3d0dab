#pragma once

#include <string>
#include <vector>

#include "sessile/simulation.h"

namespace sessile::test {

/// Holds the kinetic energy of a liquid to what may have brought it in, step by step.
///
/// Pressure between walls at rest is a projection in the metric of kinetic energy: a liquid that is nowhere compressed
/// gains nothing by it. One that is compressed by c may be pushed apart within a step, over as many spacings as it is
/// wide: sqrt(E') <= sqrt(E*) + k sqrt(W). E* is what all other forces would leave; W = sum m/2 (c w dx/dt)^2 with
/// w = n^(1/3). WCSPH gives back what compression has stored, W = sum m int p drho/rho^2.
/// PCISPH and DFSPH are no such projections: they stop at pressures that are high enough, be they too high, and DFSPH
/// starts from those of the step before, which push by dt p/(rho0 dx) whether they must or not. Theirs is
/// sqrt(E') <= (1 + o) sqrt(E*) + k sqrt(W), with that push beside sqrt(W).
///
/// Viscosity only takes. What pair forces give is at most what moves every particle by some spacings against them.
class EnergyBounds {
 public:
  explicit EnergyBounds(const Simulation& simulation) : simulation_(simulation) {}

  /// Before a step; `acceleration` by all forces [m/s^2], by the particles' ids. `pairs`: estimate of what pair forces
  /// give one particle [m/s^2].
  void look(const std::vector<Vec3d>& acceleration, double pairs);

  /// After it. A sentence for each bound that does not hold.
  std::vector<std::string> check();

  double worst_push() const { return worst_push_; }            ///< k; of PCISPH and DFSPH 0
  double worst_overshoot() const { return worst_overshoot_; }  ///< o, at k = 1
  double worst_pull() const { return worst_pull_; }            ///< work of pair forces, of m a dx
  double worst_viscosity() const { return worst_viscosity_; }  ///< power of viscosity, of what its sum may round to

 private:
  /// Sums over the particles before the step, in particle masses.
  struct Sums {
    double mass = 0, kinetic = 0, power = 0, square = 0;  // m, m v^2/2, m v.a, m a^2/2
    double pull = 0, pull_square = 0;                     // m v.b, m a.b/2, b being the pair forces' share of a
    double compression = 0, stored = 0, pressure = 0;     // m c^2/2, WCSPH's W, m p^2/2
    double viscous = 0, viscous_size = 0;                 // m v.b and m |v| |b| of viscosity
  };

  const Simulation& simulation_;
  Sums sums_;
  double pairs_ = 0;      // [m/s^2]
  double pull_ = 0;       // work of pair forces so far
  double most_mass_ = 0;  // of all particles at a time
  double emitted_ = 0;    // before the step [J]
  double worst_push_ = 0, worst_overshoot_ = 0, worst_pull_ = 0, worst_viscosity_ = 0;
};

}  // namespace sessile::test
