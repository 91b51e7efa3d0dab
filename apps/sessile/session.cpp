#include "session.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "advice.h"
#include "checkpoints.h"
#include "folder_lock.h"
#include "mesh/surface_folder.h"
#include "prepare.h"
#include "recorder.h"
#include "sessile/scene/describe.h"
#include "sessile/version.h"

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
  }

 private:
  bool said_overruled_ = false, said_unconverged_ = false;
};

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

CheckpointOutput checkpoints_of(const Scene& scene, const SessionOptions& options) {
  CheckpointOutput asked = scene.output.checkpoint;
  if (!options.checkpoints) asked.keep = 0;
  return asked;
}

/// `start`: of the wall time that counts.
SessionResult run_from(Simulation simulation, const SessionOptions& options, const StepWatch& watch,
                       const std::optional<SessionState>& before, const FolderLock& lock, Clock::time_point start) {
  const double earlier = before ? before->wall_time : 0;
  const auto wall = [&] { return earlier + since(start); };
  SessionResult result;
  refuse_if_in_use(options.folder / surface_folder_name);  // by `sessile mesh`: a run takes those surfaces out
  Recorder recorder(options.folder, simulation, before);
  Checkpoints checkpoints(options.folder, checkpoints_of(simulation.scene(), options),
                          before ? std::optional(simulation.time()) : std::nullopt);
  const auto keep_state = [&] {
    SessionState state = recorder.settle();
    state.wall_time = wall();
    checkpoints.write(simulation, session_json(state));
  };
  Progress progress(options.progress, options.name, simulation);
  if (!lock.warning().empty()) progress.warn(lock.warning());
  Warnings warnings;
  RunFacts facts;
  facts.version = version();
  facts.scene_json = to_json(simulation.scene());
  try {
    while (!simulation.finished() && !stop_asked() && result.message.empty()) {
      const auto began = Clock::now();
      simulation.step();
      result.stepping += since(began);
      lock.check();
      recorder.record(simulation);
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
    facts.status = result.status = RunStatus::failed;
    facts.message = result.message;
    facts.wall_time = wall();
    try {
      if (lock.in_place()) recorder.finish(simulation, facts);
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
    recorder.finish(simulation, facts);
  }
  result.wall = wall();
  result.frames = recorder.frames();
  result.facts = simulation_facts(simulation);
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
