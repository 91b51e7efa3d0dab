#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "sessile/measure/soundness.h"
#include "sessile/simulation.h"
#include "session.h"

namespace sessile::app {

/// What a comparison keeps of a run; verdict.json holds it.
struct RunRecord {
  std::string status;   ///< done, failed, stopped (unsound, in a search), interrupted
  std::string message;  ///< what went wrong

  bool sound = false;
  double verdict_time = 0;  ///< since when it is unsound [s]
  std::string reason;       ///< why it is unsound
  double pressure_work_share = 0;
  double unconverged_share = 0;
  double density_error = 0, density_error_max = 0;  ///< at the new positions; mean and greatest of the steps' averages
  double predicted_error = 0, predicted_error_max = 0;  ///< by the solvers' own account

  double time = 0, dt_mean = 0, dt_least = 0, dt_greatest = 0;  ///< [s]
  double iterations_per_step = 0;
  std::int64_t steps = 0, iterations = 0, divergence_iterations = 0, unconverged_solves = 0, overruled_steps = 0;
  std::int64_t particles = 0, wall_particles = 0, emitted = 0, waits = 0, out = 0, lost = 0;

  EnergyAccount energy{};

  double wall = 0, stepping = 0;  ///< [s]
  double neighbors = 0, density = 0, forces = 0, pressure = 0, integration = 0;
  std::int64_t threads = 0;
  std::string version;
  std::string scene;  ///< the resolved scene as JSON

  /// Whether the run need not be made again.
  bool finished() const { return status == "done" || status == "failed" || status == "stopped"; }
  double wall_per_second() const { return time > 0 ? stepping / time : 0; }  ///< of stepping, per simulated second
};

/// Calls f(key, member) for every figure of a record but the scene, in the order of the file.
template <class Record, class F>
void for_each_figure(Record& r, F&& f) {
  f("status", r.status);
  f("message", r.message);
  f("sound", r.sound);
  f("verdict_time_s", r.verdict_time);
  f("reason", r.reason);
  f("pressure_work_share", r.pressure_work_share);
  f("unconverged_share", r.unconverged_share);
  f("density_error", r.density_error);
  f("density_error_max", r.density_error_max);
  f("predicted_density_error", r.predicted_error);
  f("predicted_density_error_max", r.predicted_error_max);
  f("simulated_time_s", r.time);
  f("dt_mean_s", r.dt_mean);
  f("dt_least_s", r.dt_least);
  f("dt_greatest_s", r.dt_greatest);
  f("steps", r.steps);
  f("iterations", r.iterations);
  f("divergence_iterations", r.divergence_iterations);
  f("iterations_per_step", r.iterations_per_step);
  f("unconverged_solves", r.unconverged_solves);
  f("overruled_steps", r.overruled_steps);
  f("particles", r.particles);
  f("wall_particles", r.wall_particles);
  f("emitted", r.emitted);
  f("waits", r.waits);
  f("out", r.out);
  f("lost", r.lost);
  f("kinetic_at_start_J", r.energy.start);
  f("work_of_forces_J", r.energy.forces);
  f("work_of_pressure_J", r.energy.pressure);
  f("emitted_J", r.energy.emitted);
  f("out_J", r.energy.out);
  f("wall_time_s", r.wall);
  f("stepping_time_s", r.stepping);
  f("neighbors_time_s", r.neighbors);
  f("density_time_s", r.density);
  f("forces_time_s", r.forces);
  f("pressure_time_s", r.pressure);
  f("integration_time_s", r.integration);
  f("threads", r.threads);
  f("version", r.version);
}

/// Watches a run and sums up what only its steps show.
class RunObserver {
 public:
  /// `stop_unsound`: whether a run ends as soon as it is unsound.
  explicit RunObserver(bool stop_unsound) : stop_unsound_(stop_unsound) {}

  /// After each step; says why the run should end, or nothing.
  std::string look(const Simulation& simulation);

  RunRecord record(const SessionResult& result, const ResolvedScene& resolved);

 private:
  bool stop_unsound_;
  Soundness soundness_;
  double dt_least_ = 0, dt_greatest_ = 0, predicted_sum_ = 0, predicted_max_ = 0;
};

/// The text of verdict.json.
std::string verdict_json(const RunRecord& record);

/// Reads verdict.json; nothing when there is none, or none that this program could have written.
std::optional<RunRecord> read_verdict(const std::filesystem::path& file);

}  // namespace sessile::app
