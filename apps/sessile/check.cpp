#include <fmt/format.h>

#include "commands.h"
#include "prepare.h"
#include "say.h"
#include "sessile/scene/describe.h"

namespace sessile::app {
namespace {

struct CheckOptions {
  std::string scene;
  std::vector<std::string> overrides;
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

void check(const CheckOptions& options) {
  const ResolvedScene resolved = read_runnable_scene(options.scene, options.overrides);
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
  CLI::App* command = program.add_subcommand("check", "Validate a scene and print every parameter as it would run.");
  command->add_option("scene", options->scene, "scene file")->required()->type_name("SCENE");
  command->add_option("--set", options->overrides, "put a value over the scene's, e.g. time.end=2")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_flag("--json", options->json, "print the resolved scene as JSON, itself a scene file");
  command->callback([options] { check(*options); });
}

}  // namespace sessile::app
