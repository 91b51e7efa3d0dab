#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "commands.h"
#include "prepare.h"
#include "run_options.h"
#include "say.h"
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

int run(RunOptions options) {
  apply_run_options(options, "");
  const ResolvedScene resolved = read_runnable_scene(options.scene, options.overrides);
  const SessionResult result =
      run_session(resolved, {options.scene, options.folder, progress_style(options.progress), ""});
  if (result.error) std::rethrow_exception(result.error);
  const bool early = result.status == RunStatus::interrupted;
  if (early) say(stderr, fmt::format("interrupted; everything up to {:.4g} s is written\n", result.facts.time));
  if (options.progress != "json") print_end(result, options.folder);
  return early ? interrupted_code() : done;
}

}  // namespace

void add_run(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = program.add_subcommand("run", "Run a scene and write its frames, stats.csv and summary.json.");
  add_run_options(*command, *options, "folder for the results (default: results/<scene>)");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace sessile::app
