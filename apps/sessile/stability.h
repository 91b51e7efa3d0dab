#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "progress.h"
#include "schedule.h"
#include "sessile/measure/health.h"
#include "sessile/output/snapshot.h"
#include "sessile/output/summary.h"
#include "sessile/simulation.h"
#include "session_state.h"

namespace sessile::app {

/// Takes a run's steps, looks whether each went well, and does what the scene asks for where one did not.
///
/// To go back it keeps two states, at least keep_interval apart, and goes back to the older: from that the run has gone
/// on for an interval without a fault. What was written since is taken back as when a run is resumed, so that no file
/// ever tells of the steps that failed. A checkpoint holds the older state too, not the present one: a resumed run then
/// can go back as far as the undisturbed one, and does so at the same step.
class Stability {
 public:
  /// `watched`: whether more than numbers that are not finite is a fault; a program that judges runs itself asks for no
  /// more. `before`: of the run that is resumed.
  Stability(const Scene& scene, bool watched, const std::optional<SessionState>& before);

  /// One step. False: it went wrong, and the simulation stands at good() again.
  /// Throws RunError, which says all of it, when the run cannot go on.
  bool step(Simulation& simulation, Progress& progress);

  bool goes_back() const { return watched_ && settings_.on_fault == OnFault::go_back; }

  /// Whether the state at hand should be kept.
  bool due(const Simulation& simulation) const;

  /// Keeps it; with what had been written by then, when the run goes back.
  void keep(const Simulation& simulation, SessionState records);

  /// A state to go back to, and what had been written by then.
  struct Kept {
    SimulationState state;
    SessionState records;
  };
  const Kept& good() const { return kept_.front(); }
  const Scene& scene() const { return scene_; }

  const StabilityState& state() const { return state_; }

  /// For the summary of a run that has ended.
  StabilityFacts facts() const;

  /// Writes the last good state and the faulty one, when there was one, into the folder `fault` of a run's results, and
  /// returns a sentence that says so, or why it could not be. The simulation stands at the good state then.
  std::string dump(const std::filesystem::path& results, Simulation& simulation) const;

 private:
  void set_pace(Simulation& simulation);
  void tell(const RunFault& fault, Progress& progress);
  void go_back(Simulation& simulation, const RunFault& fault, Progress& progress);
  [[noreturn]] void end(const Simulation& simulation, const RunFault& fault);

  Scene scene_;
  StabilitySettings settings_;
  bool watched_;
  Health health_;
  StabilityState state_;
  double pace_ = 0;  // the dt_limit that the simulation's scene has now
  Schedule keep_schedule_;
  std::vector<Kept> kept_;  // the oldest first
  std::vector<RunFaultKind> told_;
  std::optional<RunFault> fault_;
  Snapshot faulty_;
};

}  // namespace sessile::app
