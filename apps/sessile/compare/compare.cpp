#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <memory>

#include "commands.h"
#include "comparison.h"
#include "folder_lock.h"
#include "methods.h"
#include "plots.h"
#include "prepare.h"
#include "run_options.h"
#include "say.h"
#include "sessile/core/error.h"
#include "sessile/output/file.h"
#include "signals.h"
#include "trials.h"

namespace sessile::app {
namespace {

struct CompareOptions {
  RunOptions run;
  std::string methods;
  bool search = false;
  std::optional<double> search_until, search_max;
};

/// The limits of the search, from the options and the scene.
TrialSettings settings_of(const CompareOptions& options, const Scene& scene) {
  TrialSettings settings{options.run.scene, options.run.folder, options.run.progress, 0, 0};
  settings.search_until = std::min(scene.time.end, options.search_until.value_or(scene.time.end));
  settings.search_max = options.search_max.value_or(4 * scene.time.dt_max);
  if (options.search && settings.search_max < scene.time.dt_min) {
    throw SceneError(
        fmt::format("--search-max: {:g} s is below time.dt_min, {:g} s", settings.search_max, scene.time.dt_min));
  }
  return settings;
}

/// Runs one method and, where asked for, looks for its largest step.
void run_method(const Contestant& contestant, const CompareOptions& options, const TrialSettings& settings,
                MethodReport& report) {
  report.run = run_or_reuse(contestant.resolved, settings, contestant.name, contestant.name, false);
  const bool interrupted_here = !report.run->finished();
  if (options.search && !interrupted_here) search_largest_step(contestant, settings, report);
  report.outcome = outcome_of(StatsTable(settings.folder / contestant.name / "stats.csv"));
  if (report.largest)
    report.largest_outcome = outcome_of(StatsTable(settings.folder / report.largest->folder / "stats.csv"));
}

void write_report(Comparison& comparison) {
  std::vector<std::string> drawn;
  for (const MethodReport& method : comparison.methods) {
    if (method.run && method.outcome.known) drawn.push_back(method.name);
  }
  comparison.plots_trouble =
      drawn.empty() ? "there are no plots: nothing has run" : draw_plots(comparison.folder, drawn);
  if (!drawn.empty() && !comparison.plots_trouble.empty()) say(stderr, "sessile: " + comparison.plots_trouble + "\n");
  write_whole(comparison.folder / "comparison.json", comparison_json(comparison));
  write_whole(comparison.folder / "comparison.csv", comparison_csv(comparison));
  write_whole(comparison.folder / "comparison.md", comparison_markdown(comparison));
}

int compare(CompareOptions options) {
  refuse_overrides_of_methods(options.run.overrides);
  apply_run_options(options.run, "_compared");
  const ResolvedScene scene = read_runnable_scene(options.run.scene, options.run.overrides, options.run.places);
  const std::vector<Contestant> contestants = read_contestants(options.methods, options.run.scene, scene);
  const TrialSettings settings = settings_of(options, scene.scene);
  refuse_if_in_use(settings.folder);
  // What only sampling shows, for every method before the first one runs.
  for (const Contestant& contestant : contestants) set_up(contestant.resolved, options.run.scene);

  const FolderLock lock(settings.folder);
  if (!lock.warning().empty()) say(stderr, "warning: " + lock.warning() + "\n");
  Comparison comparison;
  comparison.folder = settings.folder;
  comparison.scene_file = options.run.scene;
  comparison.scene_title = scene.scene.title;
  comparison.end = scene.scene.time.end;
  comparison.threads = omp_get_max_threads();
  comparison.search = options.search;
  comparison.search_until = settings.search_until;
  for (const Contestant& contestant : contestants) {
    MethodReport report{contestant.name, contestant.title, contestant.file.string(),
                        contestant.resolved.scene.time.fixed_dt ? "fixed" : "adaptive"};
    if (!stop_asked()) run_method(contestant, options, settings, report);
    comparison.methods.push_back(std::move(report));
  }
  comparison.interrupted = stop_asked();
  write_report(comparison);
  if (comparison.interrupted) say(stderr, "interrupted; the report tells of what is done, the same command goes on\n");
  if (options.run.progress != "json") {
    say(stdout,
        fmt::format("comparison.md, comparison.csv, comparison.json and plots are in {}\n", options.run.folder));
  }
  return comparison.interrupted ? interrupted_code() : done;
}

}  // namespace

void add_compare(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = program.add_subcommand("compare", "Run a scene with several methods and report how they differ.");
  add_run_options(*command, options->run, "folder for the results (default: results/<scene>_compared)");
  command->add_option("--methods", options->methods, "names or files of methods, with commas between, e.g. none,paper")
      ->required()
      ->type_name("LIST");
  CLI::Option* search =
      command->add_flag("--search-dt", options->search, "look for the largest fixed step at which each stays sound");
  command->add_option("--search-until", options->search_until, "trials of that search end at this simulated time")
      ->type_name("SECONDS")
      ->check(finite_and_positive, "")
      ->needs(search);
  command->add_option("--search-max", options->search_max, "no step above is tried (default: 4 * time.dt_max)")
      ->type_name("SECONDS")
      ->check(finite_and_positive, "")
      ->needs(search);
  command->callback([options, &exit_code] { exit_code = compare(*options); });
}

}  // namespace sessile::app
