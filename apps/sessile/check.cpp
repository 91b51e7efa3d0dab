#include <fmt/format.h>

#include "commands.h"
#include "prepare.h"
#include "progress.h"
#include "run_options.h"
#include "say.h"
#include "sessile/checkpoint/checkpoint.h"
#include "sessile/core/error.h"
#include "sessile/scene/describe.h"
#include "sessile/scene/spelling.h"
#include "session_state.h"

namespace sessile::app {
namespace {

struct CheckOptions {
  std::string scene;
  std::vector<std::string> overrides;
  MeshPlaces places = MeshPlaces::in_its_folder;
  bool json = false;
};

/// What follows from the parameters: sizes and the bounds that are known before a run.
std::string derived(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  double tension = 0;
  for (const Force& force : scene.forces) {
    tension += std::visit([&](const auto& model) { return model.tension(simulation.units()); }, force);
  }
  std::string text = "\nderived\n";
  text += fmt::format("  particles at the start      {}\n", simulation.particles().size());
  text += fmt::format("  boundary particles          {}\n", simulation.walls().size());
  text += fmt::format("  support radius              {:g} m\n", scene.support_radius());
  text += fmt::format("  particle mass               {:g} kg\n", simulation.units().particle_mass());
  text += fmt::format("  macroscopic surface tension {:g} N/m\n", tension);
  text +=
      fmt::format("  memory at the start         {:.1f} MiB\n", static_cast<double>(simulation.bytes()) / (1 << 20));
  return text;
}

/// What is in a checkpoint, and that it is whole.
void check_checkpoint(const CheckOptions& options) {
  if (!options.overrides.empty()) throw CLI::ValidationError("--set", "is for scenes; this is a checkpoint");
  const Checkpoint checkpoint = read_checkpoint(options.scene);
  if (options.json) {
    say(stdout, checkpoint.scene_json + "\n");
    return;
  }
  const Scene scene = read_resolved_text(checkpoint.scene_json, options.scene, {}, {}, MeshPlaces::unasked).scene;
  const SimulationState& state = checkpoint.state;
  const Totals& totals = state.totals;
  std::string text = fmt::format("{}: a whole checkpoint, of format {}\n", options.scene, checkpoint.format);
  if (!scene.title.empty()) text += fmt::format("  scene           {}\n", scene.title);
  text += fmt::format("  written by      version {}, with steps for {}\n", printable(checkpoint.version),
                      printable(checkpoint.isa));
  text += fmt::format("  simulated time  {:.9g} of {:g} s, after {} steps; the last one {:.3g} s ({})\n", state.time,
                      scene.time.end, totals.steps, state.last_step.dt, state.last_step.bound);
  text += fmt::format("  particles       {}; {} let in, {} out, {} lost\n", state.particles.size(), totals.emitted,
                      totals.out, totals.lost);
  try {
    const SessionState session = session_of(checkpoint.session);
    text += fmt::format("  results         {} frames, {} surfaces, {} bytes of stats.csv, {} of wall time\n",
                        session.frame_times.size(), session.surface_times.size(), session.stats_bytes,
                        duration_text(session.wall_time));
  } catch (const Error&) {
    text += "  results         none: no run wrote it\n";
  }
  say(stdout, text);
}

void check(const CheckOptions& options) {
  if (is_checkpoint(options.scene)) {
    check_checkpoint(options);
    return;
  }
  const ResolvedScene resolved = read_runnable_scene(options.scene, options.overrides, options.places);
  const Simulation simulation = set_up(resolved, options.scene);
  if (options.json) {
    say(stdout, to_json(resolved.scene) + "\n");
    return;
  }
  say(stdout, describe(resolved) + derived(simulation));
}

}  // namespace

void add_check(CLI::App& program, int&) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = program.add_subcommand(
      "check", "Validate a scene and print every parameter as it would run, or describe a checkpoint.");
  command->add_option("scene", options->scene, "scene file, or a checkpoint")->required()->type_name("SCENE");
  command->add_option("--set", options->overrides, "put a value over the scene's, e.g. time.end=2")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_allow_outside(*command, options->places);
  command->add_flag("--json", options->json, "print the resolved scene as JSON, itself a scene file");
  command->callback([options] { check(*options); });
}

}  // namespace sessile::app
