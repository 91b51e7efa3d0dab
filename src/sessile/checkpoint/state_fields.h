#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>

#include "sessile/core/error.h"
#include "sessile/simulation_state.h"
#include "sessile/time/time_step.h"

/// What a checkpoint holds of a state, in its order: one list for writing and reading. A field that is added goes to
/// the end of its struct, makes a new checkpoint_format, and has its default where an older file is read.
namespace sessile {

/// `S` is `T` or `const T`.
template <class S, class T>
concept Is = std::is_same_v<std::remove_const_t<S>, T>;

/// One of the words that name a bound; its text belongs to the program, not to the file.
template <class A, class S>
void bound_word(A& archive, S& word) {
  if constexpr (std::is_const_v<S>) {
    archive(word);
  } else {
    std::string text;
    archive(text);
    const auto found = std::find(time_step_bounds.begin(), time_step_bounds.end(), text);
    if (found == time_step_bounds.end()) throw Error("names a bound of the time step that there is not");
    word = *found;
  }
}

template <class A, Is<Vec3d> S>
void state_fields(A& archive, S& s) {
  archive(s.x, s.y, s.z);
}
template <class A, Is<Particles> S>
void state_fields(A& archive, S& s) {
  s.for_each_field([&](auto& array) { archive(array); });
}
template <class A, Is<LayerProgress> S>
void state_fields(A& archive, S& s) {
  archive(s.emitted, s.waiting);
}
template <class A, Is<SolidForce> S>
void state_fields(A& archive, S& s) {
  archive(s.force, s.torque);
}
template <class A, Is<StepReport> S>
void state_fields(A& archive, S& s) {
  archive(s.dt);
  bound_word(archive, s.bound);
  bound_word(archive, s.overruled);
  archive(s.iterations, s.divergence_iterations, s.converged, s.predicted_error, s.predicted_error_max,
          s.kinetic_energy);
}
template <class A, Is<EnergyAccount> S>
void state_fields(A& archive, S& s) {
  archive(s.start, s.forces, s.pressure, s.emitted, s.out);
}
template <class A, Is<Totals> S>
void state_fields(A& archive, S& s) {
  archive(s.steps, s.iterations, s.divergence_iterations, s.solves, s.unconverged_solves, s.overruled_steps, s.emitted,
          s.waits, s.out, s.lost, s.energy);
}
template <class A, Is<StageTimes> S>
void state_fields(A& archive, S& s) {
  archive(s.neighbors, s.density, s.forces, s.time_step, s.pressure, s.integration, s.clock_reads);
}
template <class A, Is<SimulationState> S>
void state_fields(A& archive, S& s) {
  archive(s.time, s.particles, s.next_id, s.sources, s.forces, s.solids_digest, s.last_step, s.totals, s.stage_times);
}

}  // namespace sessile
