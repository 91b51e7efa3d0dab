#include <fmt/format.h>
#include <omp.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <optional>

#include "commands.h"
#include "prepare.h"
#include "progress.h"
#include "recorder.h"
#include "say.h"
#include "sessile/scene/describe.h"
#include "sessile/version.h"

namespace sessile::app {
namespace {

struct RunOptions {
  std::string scene;
  std::string folder;
  std::vector<std::string> overrides;
  std::optional<double> until;
  int threads = 0;
  std::string progress = "auto";
};

// Set by the signal handler, which may touch nothing else.
volatile std::sig_atomic_t stop_asked = 0;

/// Ctrl-C ends the run after the step at hand; a second one ends the program at once.
void stop_on_signals() {
  const auto ask = [](int signal) {
    stop_asked = 1;
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, ask);
  std::signal(SIGTERM, ask);
  std::signal(SIGPIPE, [](int) { stop_asked = 1; });  // whoever read along has gone, as with Ctrl-C
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit then is an error of the write, with a sentence
}

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

/// Says here what the range check of time.end would say under a name that the user did not type.
std::string finite_and_positive(const std::string& word) {
  double value = 0;
  const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || rest != word.data() + word.size()) return {};  // no number: CLI11 says so
  if (error != std::errc{} || !std::isfinite(value)) return word + " is not a finite number";
  return value > 0 ? "" : "must be above 0 s, found " + word;
}

void print_end(const Simulation& simulation, const std::string& folder, std::int64_t frames, double wall) {
  const Totals& totals = simulation.totals();
  const auto steps = static_cast<double>(std::max<std::int64_t>(totals.steps, 1));
  std::string text = fmt::format(
      "{} steps to {:.4g} s in {:.1f} s of wall time, {:.2f} ms a step, {:.1f} iterations a step\n", totals.steps,
      simulation.time(), wall, 1e3 * wall / steps, static_cast<double>(totals.iterations) / steps);
  text += fmt::format("{} particles, {} out, {} lost", simulation.particles().size(), totals.out, totals.lost);
  if (totals.unconverged_solves > 0) text += fmt::format("; {} solves above their error", totals.unconverged_solves);
  if (totals.overruled_steps > 0) text += fmt::format("; {} steps above a stability bound", totals.overruled_steps);
  if (totals.waits > 0) text += fmt::format("; {} layers had to wait", totals.waits);
  text += fmt::format("\n{} frames, stats.csv and summary.json are in {}\n", frames, folder);
  say(stdout, text);
}

int run(RunOptions options) {
  if (options.threads > 0) omp_set_num_threads(options.threads);
  if (options.until) options.overrides.push_back(fmt::format("time.end={:.17g}", *options.until));
  if (options.folder.empty()) {
    options.folder = (std::filesystem::path("results") / std::filesystem::path(options.scene).stem()).string();
  }
  const ResolvedScene resolved = read_runnable_scene(options.scene, options.overrides);

  const auto start = std::chrono::steady_clock::now();
  const auto wall = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  Simulation simulation = set_up(resolved, options.scene);
  stop_on_signals();  // only now: until here nothing is written, and a signal may end the program at once
  Recorder recorder(options.folder, simulation);
  Progress progress(progress_style(options.progress));
  Warnings warnings;
  RunFacts facts;
  facts.version = version();
  facts.scene_json = to_json(resolved.scene);
  try {
    while (!simulation.finished() && !stop_asked) {
      simulation.step();
      recorder.record(simulation);
      warnings.look(simulation, progress);
      progress.update(simulation);
    }
  } catch (const std::exception& e) {
    // What has been written stays good; the summary says how it ended, if the disk still takes it.
    facts.status = RunStatus::failed;
    facts.message = e.what();
    facts.wall_time = wall();
    try {
      recorder.finish(simulation, facts);
    } catch (const std::exception&) {
      // The first error is the one to report.
    }
    throw;
  }
  facts.status = stop_asked ? RunStatus::interrupted : RunStatus::done;
  progress.finish(simulation);
  facts.wall_time = wall();
  recorder.finish(simulation, facts);
  if (stop_asked) say(stderr, fmt::format("interrupted; everything up to {:.4g} s is written\n", simulation.time()));
  if (options.progress != "json") print_end(simulation, options.folder, recorder.frames(), wall());
  return stop_asked ? interrupted : done;
}

}  // namespace

void add_run(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = program.add_subcommand("run", "Run a scene and write its frames, stats.csv and summary.json.");
  command->add_option("scene", options->scene, "scene file")->required()->type_name("SCENE");
  command->add_option("-o,--output", options->folder, "folder for the results (default: results/<scene>)")
      ->type_name("DIR");
  command->add_option("--set", options->overrides, "put a value over the scene's, e.g. time.fixed_dt=0.002")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--until", options->until, "end at this simulated time, in place of the scene's time.end")
      ->type_name("SECONDS")
      ->check(finite_and_positive, "");
  command->add_option("--threads", options->threads, "threads to use (default: all)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->add_option("--progress", options->progress, "how progress is shown")
      ->check(CLI::IsMember({"auto", "plain", "json", "none"}))
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace sessile::app
