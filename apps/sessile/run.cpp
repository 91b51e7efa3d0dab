#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "advice.h"
#include "checkpoints.h"
#include "commands.h"
#include "folder_lock.h"
#include "prepare.h"
#include "resume.h"
#include "run_options.h"
#include "say.h"
#include "sessile/core/error.h"
#include "session.h"
#include "signals.h"

namespace sessile::app {
namespace {

void print_end(const SessionResult& result, const std::string& folder) {
  const Totals& totals = result.facts.totals;
  const auto steps = static_cast<double>(std::max<std::int64_t>(totals.steps, 1));
  std::string text = fmt::format(
      "{} steps to {:.4g} s in {:.1f} s of wall time, {:.2f} ms a step, {:.1f} iterations a step\n", totals.steps,
      result.facts.time, result.wall, 1e3 * result.wall / steps, static_cast<double>(totals.iterations) / steps);
  text += fmt::format("{} particles, {} out, {} lost", result.facts.particles, totals.out, totals.lost);
  if (totals.unconverged_solves > 0) text += fmt::format("; {} solves above their error", totals.unconverged_solves);
  if (totals.overruled_steps > 0) text += fmt::format("; {} steps above a stability bound", totals.overruled_steps);
  if (totals.waits > 0) text += fmt::format("; {} layers had to wait", totals.waits);
  text += fmt::format("\n{} frames, stats.csv and summary.json are in {}\n", result.frames, folder);
  say(stdout, text);
}

/// A run that ended for a fault of the machine: what can be done about that, and then goes on where it was.
int say_failure(const std::exception& fault, const std::string& folder, bool begun) {
  tell(fault);
  const bool own_fault = dynamic_cast<const RunError*>(&fault) != nullptr;  // it would come again
  // Without the lines so far it cannot go on.
  const bool goes_on = has_checkpoints(folder) && std::filesystem::exists(std::filesystem::path(folder) / "stats.csv");
  if (begun && !own_fault && goes_on) say(stderr, fmt::format("then go on with: sessile run --resume {}\n", folder));
  return run_failed;
}

/// Runs, and says how to go on where a run fails that had begun: before, checkpoints in the folder are not its own.
int attempt(const std::string& folder, const bool& begun, const std::function<int()>& work) {
  try {
    return work();
  } catch (const SceneError&) {
    throw;
  } catch (const FolderInUse&) {
    throw;
  } catch (const std::exception& e) {
    return say_failure(e, folder, begun);
  }
}

int say_end(const SessionResult& result, const RunOptions& options) {
  if (result.error) std::rethrow_exception(result.error);
  const bool early = result.status == RunStatus::interrupted;
  if (early) {
    say(stderr, fmt::format("interrupted; everything up to {:.4g} s is written{}\n", result.facts.time,
                            result.resumable ? ", and it goes on with: sessile run --resume " + options.folder : ""));
  }
  if (options.progress != "json") print_end(result, options.folder);
  return early ? interrupted_code() : done;
}

int run(RunOptions options) {
  apply_run_options(options, "");
  const ResolvedScene resolved = read_runnable_scene(options.scene, options.overrides, options.places);
  const SessionOptions session{options.scene, options.folder, progress_style(options.progress), ""};
  bool begun = false;
  return attempt(options.folder, begun, [&] {
    const SessionResult result = run_session(resolved, session);
    begun = true;
    return say_end(result, options);
  });
}

int resume(RunOptions options, const std::string& folder, std::optional<double> at) {
  options.folder = folder;
  apply_run_options(options, "");
  const ResumeOptions wanted{folder, at, options.overrides};
  std::optional<FolderLock> lock;  // before anything is read that another run might go on with
  if (std::filesystem::is_directory(folder)) lock.emplace(folder);
  Resumable run = open_run(wanted);
  if (options.progress != "none") {
    for (const std::string& note : run.notes) say(stderr, "warning: " + note + "\n");
  }
  if ((!at || run.simulation.finished()) && is_complete(folder, run.simulation)) {
    const double end = run.simulation.scene().time.end;
    say(stderr, fmt::format("{} is at {:.4g} s, its end; --until lets it go on\n", folder, end));
    return done;
  }
  try {
    require_results(folder, run);
  } catch (const FolderInUse&) {
    throw;
  } catch (const FileError& e) {
    say(stderr, fmt::format("sessile: {}\n", e.what()));  // nothing has been touched, and it would come again
    return run_failed;
  }
  const SessionOptions session{folder, folder, progress_style(options.progress), "", true, run.changed};
  return attempt(folder, true, [&] {
    return say_end(resume_session(std::move(run.simulation), session, run.before, *lock), options);
  });
}

}  // namespace

void add_run(CLI::App& program, int& exit_code) {
  struct Options : RunOptions {
    std::string resumed;
    std::optional<double> at;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("run", "Run a scene, or go on with a run; write its frames, stats.csv and summary.json.");
  add_run_options(*command, *options, "folder for the results (default: results/<scene>)");
  CLI::Option* scene = command->get_option("scene")->required(false);
  CLI::Option* resumed = command->add_option("--resume", options->resumed, "go on with the run in this folder")
                             ->type_name("DIR")
                             ->excludes(scene)
                             ->excludes(command->get_option("--output"));
  command->add_option("--at", options->at, "from the last checkpoint that is not after this simulated time")
      ->type_name("SECONDS")
      ->check(finite_and_positive, "")
      ->needs(resumed);
  command->callback([options, resumed, scene, &exit_code] {
    if (resumed->count() == 0 && scene->count() == 0) throw CLI::RequiredError("a SCENE, or --resume DIR,");
    exit_code = resumed->count() > 0 ? resume(*options, options->resumed, options->at) : run(*options);
  });
}

}  // namespace sessile::app
