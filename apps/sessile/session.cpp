#include "session.h"

#include <fmt/format.h>

#include <chrono>
#include <tuple>
#include <utility>

#include "advice.h"
#include "checkpoints.h"
#include "fault_dump.h"
#include "folder_lock.h"
#include "mesh/surface_folder.h"
#include "prepare.h"
#include "recorder.h"
#include "sessile/core/error.h"
#include "sessile/measure/diagnostics.h"
#include "sessile/scene/describe.h"
#include "sessile/version.h"
#include "stability.h"

namespace sessile::app {
namespace {

/// Says once what the user should know while it happens.
class Warnings {
 public:
  void look(const Simulation& simulation, Progress& progress) {
    const StepReport& last = simulation.last_step();
    if (!last.overruled.empty() && !said_overruled_) {
      said_overruled_ = true;
      progress.warn(fmt::format("at {:.4g} s the step of {:g} s ({}) exceeds the {} bound", simulation.time(), last.dt,
                                last.bound, last.overruled));
    }
    if (!last.converged && !said_unconverged_) {
      said_unconverged_ = true;
      progress.warn(
          fmt::format("at {:.4g} s the pressure solve ended at its {} iterations with an average density error "
                      "of {:.3g} %",
                      simulation.time(), last.iterations, 100 * last.predicted_error));
    }
    if (!said_soft_ && !promises_density(simulation.scene().pressure)) look_at_density(simulation, progress);
  }

 private:
  /// A solver that has no error to reach compresses the liquid by what its speed of sound allows. What a scene begins
  /// with is not its doing.
  void look_at_density(const Simulation& simulation, Progress& progress) {
    if (simulation.totals().steps < simulation.scene().stability.density_steps) return;
    const double average = compression(simulation.density()).average;
    if (average <= simulation.scene().stability.density_limit) return;
    said_soft_ = true;
    progress.warn(
        fmt::format("at {:.4g} s the liquid is compressed by {:.3g} % on average: a greater pressure.sound_speed "
                    "compresses it less",
                    simulation.time(), 100 * average));
  }

  bool said_overruled_ = false, said_unconverged_ = false, said_soft_ = false;
};

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

CheckpointOutput checkpoints_of(const Scene& scene, const SessionOptions& options) {
  CheckpointOutput asked = scene.output.checkpoint;
  if (!options.checkpoints) asked.keep = 0;
  return asked;
}

/// That the folder has gone tells more than what could not be written into it; a fault of the run is told besides.
std::pair<std::exception_ptr, std::string> why_gone(const FolderLock& lock, const std::exception& fault) {
  try {
    lock.check();
  } catch (const FileError& e) {
    const bool own_fault = dynamic_cast<const RunError*>(&fault) != nullptr;
    const std::string message = own_fault ? fmt::format("{}. Besides, {}", fault.what(), e.what()) : e.what();
    return {std::make_exception_ptr(FileError(message, e.reason)), message};
  }
  return {std::current_exception(), fault.what()};  // it is back
}

/// `start`: of the wall time that counts.
SessionResult run_from(Simulation simulation, const SessionOptions& options, const StepWatch& watch,
                       const std::optional<SessionState>& before, const FolderLock& lock, Clock::time_point start) {
  const double earlier = before ? before->wall_time : 0;
  const auto wall = [&] { return earlier + since(start); };
  SessionResult result;
  refuse_if_in_use(options.folder / surface_folder_name);  // by `sessile mesh`: a run takes those surfaces out
  refuse_if_in_use(options.folder / fault_folder_name);    // by a run that goes on from that state
  std::optional<Recorder> recorder(std::in_place, options.folder, simulation, before);
  Stability stability(simulation.scene(), options.checkpoints, before);
  Checkpoints checkpoints(options.folder, checkpoints_of(simulation.scene(), options),
                          before ? std::optional(simulation.time()) : std::nullopt);
  const auto records = [&] {
    SessionState state = recorder->settle();
    state.wall_time = wall();
    state.stability = stability.state();
    return state;
  };
  const auto keep_state = [&] {
    if (stability.goes_back()) {
      const Stability::Kept& good = stability.good();
      checkpoints.write(stability.scene(), good.state, session_json(good.records));
    } else {
      checkpoints.write(stability.scene(), simulation.state(), session_json(records()));
    }
    checkpoints.served(simulation.time());
  };
  const auto keep_good_state = [&] { stability.keep(simulation, stability.goes_back() ? records() : SessionState{}); };
  Progress progress(options.progress, options.name, simulation);
  if (!lock.warning().empty()) progress.warn(lock.warning());
  Warnings warnings;
  RunFacts facts;
  facts.version = version();
  facts.scene_json = to_json(simulation.scene());
  try {
    if (options.checkpoints) keep_good_state();
    // So that a kill before the next one does not undo what the user has changed.
    if (options.changed && checkpoints.wanted()) keep_state();
    while (!simulation.finished() && !stop_asked() && result.message.empty()) {
      const auto began = Clock::now();
      const bool well = stability.step(simulation, progress);
      result.stepping += since(began);
      lock.check();
      if (!well) {
        recorder.emplace(options.folder, simulation, stability.good().records);
        continue;
      }
      recorder->record(simulation);
      if (stability.due(simulation)) keep_good_state();
      if (checkpoints.due(simulation)) keep_state();
      warnings.look(simulation, progress);
      progress.update(simulation);
      if (watch) result.message = watch(simulation);
    }
    // Before the last frame and line, which a run that goes on from here would not have.
    if (checkpoints.wanted()) keep_state();
    result.resumable = checkpoints.wanted();
  } catch (const std::exception& e) {
    // What has been written stays good; the summary says how it ended, if the disk still takes it.
    result.error = std::current_exception();
    result.message = sentence(e);
    if (!lock.in_place()) std::tie(result.error, result.message) = why_gone(lock, e);
    facts.status = result.status = RunStatus::failed;
    facts.message = result.message;
    facts.wall_time = wall();
    facts.stability = stability.facts();
    try {
      if (recorder && lock.in_place()) recorder->finish(simulation, facts);
    } catch (const std::exception&) {
      // The first error is the one to report.
    }
  }
  if (!result.error) {
    const RunStatus early = stop_asked() ? RunStatus::interrupted : RunStatus::done;
    facts.status = result.status = result.message.empty() ? early : RunStatus::stopped;
    facts.message = result.message;
    progress.finish(simulation);
    facts.wall_time = wall();
    facts.stability = stability.facts();
    try {
      recorder->finish(simulation, facts);
    } catch (const std::exception& e) {
      result.error = std::current_exception();
      result.message = sentence(e);
      result.status = RunStatus::failed;
    }
  }
  result.wall = wall();
  result.frames = recorder ? recorder->frames() : 0;
  result.facts = simulation_facts(simulation);
  // Not into a folder that has taken the place of the run's.
  if (const std::string kept = lock.in_place() ? stability.dump(options.folder, simulation) : ""; !kept.empty()) {
    result.error = std::make_exception_ptr(RunError(result.message + ".\n" + kept));
  }
  return result;
}

}  // namespace

SessionResult run_session(const ResolvedScene& resolved, const SessionOptions& options, const StepWatch& watch) {
  const auto start = Clock::now();
  refuse_if_in_use(options.folder);  // before a set-up that may take long
  Simulation simulation = set_up(resolved, options.scene_file);
  heed_signals();  // only now: until here nothing is written, and a signal may end the program at once
  const FolderLock lock(options.folder);
  return run_from(std::move(simulation), options, watch, {}, lock, start);
}

SessionResult resume_session(Simulation simulation, const SessionOptions& options, const SessionState& before,
                             const FolderLock& lock) {
  heed_signals();
  return run_from(std::move(simulation), options, {}, before, lock, Clock::now());
}

}  // namespace sessile::app
