#pragma once

#include <string>
#include <vector>

#include "property/energy_bounds.h"
#include "sessile/simulation.h"

namespace sessile::test {

/// Steps a simulation and holds every step to what each owes whatever the scene: finite numbers, particles that
/// balance, momentum that comes from gravity, solids and emitters alone, kinetic energy that its account explains,
/// compression that is met or reported.
class Ledger {
 public:
  explicit Ledger(Simulation& simulation);

  /// One step, and all checks of it.
  void step();

  /// A sentence for each thing that did not hold; after the first few, silence.
  const std::vector<std::string>& faults() const { return faults_; }

  /// The greatest share of its tolerance that momentum, and energy, have come to: figures for the docs.
  double worst_momentum() const { return worst_momentum_; }
  double worst_energy() const { return worst_energy_; }
  double worst_move() const { return worst_move_; }  ///< greatest way of a particle in a step [dx]
  const EnergyBounds& energy_bounds() const { return bounds_; }
  double worst_density() const { return worst_density_; }  ///< average compression over rest density after a step

 private:
  /// What a step starts from, by the particles' ids.
  struct Before {
    std::vector<Vec3d> velocity, acceleration;
    Vec3d momentum{}, rate{};  // rate: of change, but by solids [per particle mass of rho0 dx^3]
    Totals totals;
    bool momentum_is_known = true;  // whether `rate` holds all of it
  };

  Before look() const;
  void check_counts(const Before& before);
  void check_numbers();
  void check_motion(const Before& before);
  void check_compression(const Before& before);
  void fault(std::string sentence);

  Simulation& simulation_;
  EnergyBounds bounds_;
  std::size_t started_;  // particles at the start, the first layers not among them
  double energy_scale_ = 0;
  double worst_momentum_ = 0, worst_energy_ = 0, worst_move_ = 0, worst_density_ = 0;
  std::vector<std::string> faults_;
};

}  // namespace sessile::test
