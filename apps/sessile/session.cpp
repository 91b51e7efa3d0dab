#include "session.h"

#include <fmt/format.h>

#include <chrono>

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

}  // namespace

SessionResult run_session(const ResolvedScene& resolved, const SessionOptions& options, const StepWatch& watch) {
  const auto start = Clock::now();
  SessionResult result;
  refuse_if_in_use(options.folder);  // before a set-up that may take long
  Simulation simulation = set_up(resolved, options.scene_file);
  heed_signals();  // only now: until here nothing is written, and a signal may end the program at once
  const FolderLock lock(options.folder);
  refuse_if_in_use(options.folder / surface_folder_name);  // by `sessile mesh`: the run takes those surfaces out
  Recorder recorder(options.folder, simulation);
  Progress progress(options.progress, options.name);
  if (!lock.warning().empty()) progress.warn(lock.warning());
  Warnings warnings;
  RunFacts facts;
  facts.version = version();
  facts.scene_json = to_json(resolved.scene);
  try {
    while (!simulation.finished() && !stop_asked() && result.message.empty()) {
      const auto before = Clock::now();
      simulation.step();
      result.stepping += since(before);
      lock.check();
      recorder.record(simulation);
      warnings.look(simulation, progress);
      progress.update(simulation);
      if (watch) result.message = watch(simulation);
    }
  } catch (const std::exception& e) {
    // What has been written stays good; the summary says how it ended, if the disk still takes it.
    result.error = std::current_exception();
    result.message = e.what();
    facts.status = result.status = RunStatus::failed;
    facts.message = result.message;
    facts.wall_time = since(start);
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
    facts.wall_time = since(start);
    recorder.finish(simulation, facts);
  }
  result.wall = since(start);
  result.frames = recorder.frames();
  result.facts = simulation_facts(simulation);
  return result;
}

}  // namespace sessile::app
