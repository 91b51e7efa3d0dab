#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "commands.h"
#include "prepare.h"
#include "run_options.h"
#include "sessile/core/error.h"
#include "sessile/results/results.h"
#include "view/keys.h"
#include "view/live_source.h"
#include "view/result_source.h"
#include "view/viewer.h"
#include "view/window.h"

namespace sessile::app {
namespace {

struct ViewOptions {
  std::string source, output = ".", size = "1280x800", field, look = "particles";
  std::vector<std::string> overrides;
  int threads = 0;
  std::int64_t frames = 0;
  bool paused = false;
  MeshPlaces places = MeshPlaces::in_its_folder;
};

/// Width and height of "1280x800"; what is wrong otherwise, for CLI11.
std::string check_size(const std::string& text) {
  static const std::regex pattern("[1-9][0-9]{2,4}x[1-9][0-9]{2,4}");
  return std::regex_match(text, pattern) ? "" : "must be WIDTHxHEIGHT, such as 1280x800, found " + text;
}

/// "spill" of scenes/spill.json, and of a folder results/spill/.
std::string name_of(const std::filesystem::path& source) {
  const std::filesystem::path plain = source.lexically_normal();
  const std::string name = (plain.has_filename() ? plain.stem() : plain.parent_path().filename()).string();
  return name.empty() || name == "." || name == ".." ? "results" : name;
}

int view(const ViewOptions& options) {
  const auto cut = options.size.find('x');
  const int width = std::stoi(options.size.substr(0, cut)), height = std::stoi(options.size.substr(cut + 1));
  viewer::Settings settings;
  settings.field = options.field;
  settings.appearance.look = options.look == "liquid"    ? draw::Look::liquid
                             : options.look == "surface" ? draw::Look::surface
                                                         : draw::Look::particles;
  const std::string name = name_of(options.source);
  const std::string title = fmt::format("{} - Sessile", name);
  std::error_code error;
  std::unique_ptr<viewer::Source> source;
  if (std::filesystem::is_directory(options.source, error)) {
    if (!options.overrides.empty()) {
      throw SceneError("--set changes a scene; " + options.source + " is a folder of results");
    }
    source = std::make_unique<viewer::ResultSource>(open_results(options.source));
  } else {
    const ResolvedScene resolved = read_runnable_scene(options.source, options.overrides, options.places);
    source = std::make_unique<viewer::LiveSource>(set_up(resolved, options.source), options.threads);
  }
  viewer::Window window(title, width, height);
  viewer::Viewer viewer(window, *source, settings, {name, options.output, options.frames});
  if (!options.paused) source->act(viewer::Action::play);
  viewer.run();
  return done;
}

}  // namespace

void add_view(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* command =
      program.add_subcommand("view", "Show a scene while it runs, or the results of a run, in a window.");
  command->add_option("source", options->source, "scene file, or folder of results")
      ->required()
      ->type_name("SCENE|DIR");
  command->add_option("-o,--output", options->output, "folder for saved pictures and videos (default: this one)")
      ->type_name("DIR");
  command->add_option("--set", options->overrides, "put a value over the scene's, e.g. time.fixed_dt=0.002")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_allow_outside(*command, options->places);
  command->add_option("--threads", options->threads, "threads for the steps (default: all)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--paused", options->paused, "wait for Space, instead of running at once");
  command->add_option("--field", options->field, "what colours at first: speed, density ...")->type_name("NAME");
  command->add_option("--look", options->look, "how the liquid looks at first")
      ->check(CLI::IsMember({"particles", "liquid", "surface"}))
      ->capture_default_str();
  command->add_option("--size", options->size, "of the window")
      ->type_name("WxH")
      ->check(check_size, "")
      ->capture_default_str();
  command->add_option("--frames", options->frames, "close the window after so many drawn frames")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 40));
  command->footer(viewer::keys_text());
  command->callback([options, &exit_code] { exit_code = view(*options); });
}

}  // namespace sessile::app
