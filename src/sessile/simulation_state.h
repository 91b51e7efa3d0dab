#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "sessile/particles/emitter.h"
#include "sessile/particles/particles.h"
#include "sessile/walls/walls.h"

namespace sessile {

/// Wall time [s] spent in each stage since the start. All of a step but a few assignments belongs to some stage.
struct StageTimes {
  double neighbors = 0, density = 0, forces = 0, time_step = 0, pressure = 0, integration = 0;
  std::int64_t clock_reads = 0;  ///< readings of the clock that these took

  double sum() const { return neighbors + density + forces + time_step + pressure + integration; }
};

/// What the last step did.
struct StepReport {
  double dt = 0;  ///< [s]
  std::string_view
      bound;  ///< what set dt: cfl, sound, solver, force, viscosity, capillary, growth, dt_max, dt_min, fixed
  std::string_view overruled;      ///< the stability bound that a fixed dt or dt_min exceeds, or ""
  int iterations = 0;              ///< of the pressure solve
  int divergence_iterations = 0;   ///< of the solve that frees the velocities of divergence, if the solver has one
  bool converged = true;           ///< whether every solve reached its error
  double predicted_error = 0;      ///< average compression over rest density that the solver predicts
  double predicted_error_max = 0;  ///< the greatest one
  double kinetic_energy = 0;       ///< of all particles after it [J]
};

/// Kinetic energy [J] and where it comes from, since the start: kinetic = start + forces + pressure + emitted - out.
/// The work of an acceleration a over a step is m a . (v + v')/2 dt, v and v' being the velocities before and after.
struct EnergyAccount {
  double start = 0;     ///< kinetic energy at the start
  double forces = 0;    ///< work of all accelerations but pressure's: gravity, viscosity, tension, adhesion
  double pressure = 0;  ///< work of pressure; that of an incompressible liquid between walls at rest only takes
  double emitted = 0;   ///< kinetic energy let in by emitters
  double out = 0;       ///< kinetic energy that left an open domain

  double kinetic() const { return start + forces + pressure + emitted - out; }
};

/// Counts since the start.
struct Totals {
  std::int64_t steps = 0;
  std::int64_t iterations = 0;
  std::int64_t divergence_iterations = 0;
  std::int64_t solves = 0;  ///< pressure solves, those that free velocities of divergence among them
  std::int64_t unconverged_solves = 0;
  std::int64_t overruled_steps = 0;  ///< steps in which a fixed dt or dt_min exceeded a stability bound
  std::int64_t emitted = 0;          ///< particles let in by emitters
  std::int64_t waits = 0;            ///< layers that fell due while their place was taken
  std::int64_t out = 0;              ///< particles that left an open domain
  std::int64_t lost = 0;             ///< passages through a solid; a position that is not finite ends the run
  EnergyAccount energy{};
};

/// Everything of a simulation that its scene does not tell: what a step reads of the steps before it, and what has been
/// counted since the start. A simulation made of a scene and this goes on as the one it was taken from, bit for bit.
struct SimulationState {
  double time = 0;  ///< [s]
  Particles particles;
  std::int64_t next_id = 0;
  std::vector<LayerProgress> sources;  ///< one per emitter
  std::vector<SolidForce> forces;      ///< on each solid, in the last step
  std::uint64_t solids_digest = 0;     ///< of the solids' samples: a mesh file that has changed since makes others
  StepReport last_step;
  Totals totals;
  StageTimes stage_times;
};

}  // namespace sessile
