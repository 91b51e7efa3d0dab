#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "blender.h"
#include "commands.h"
#include "film.h"
#include "folder_lock.h"
#include "job.h"
#include "mesh/selection.h"
#include "run_options.h"
#include "say.h"
#include "sessile/core/error.h"
#include "sessile/output/file.h"
#include "settings.h"
#include "signals.h"
#include "surfaces.h"
#include "used_settings.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  std::string results;
  std::string output;
  std::string frames;
  std::string size;
  std::string look, samples, background;
  std::vector<std::string> camera;     ///< KEY=VALUE
  std::vector<std::string> overrides;  ///< PATH=VALUE, within the settings
  std::string blend;
  std::string video;
  bool no_video = false;
  bool again = false;
  double rate = 0;  ///< frames per second; 0: as fast as the liquid was
  int threads = 0;
  std::string progress = "auto";
};

/// All options that speak of settings, as overrides of the scene's.
std::vector<std::string> overrides_of(const RenderOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) overrides.push_back(fmt::format("{}={}", key, value));
  };
  add("look", options.look);
  add("samples", options.samples);
  add("background", options.background);
  for (const std::string& each : options.camera) overrides.push_back("camera." + each);
  if (!options.size.empty()) {
    const std::size_t cross = options.size.find('x');
    if (cross == std::string::npos) throw SceneError(fmt::format("--size: expected 1280x720, found {}", options.size));
    add("width", options.size.substr(0, cross));
    add("height", options.size.substr(cross + 1));
  }
  return overrides;
}

std::vector<SurfaceFile> chosen(const Surfaces& surfaces, const std::string& selection) {
  if (selection.empty()) return surfaces.frames;
  std::vector<SurfaceFile> frames;
  for (const std::size_t place : selected(selection, surfaces.frames.size())) {
    frames.push_back(surfaces.frames[place]);
  }
  if (frames.empty()) {
    throw SceneError(fmt::format("--frames {}: {} lists {} frames, and none of these", selection,
                                 surfaces.list.string(), surfaces.frames.size()));
  }
  return frames;
}

std::vector<std::int64_t> numbers(const std::vector<SurfaceFile>& frames) {
  std::vector<std::int64_t> list;
  for (const SurfaceFile& each : frames) list.push_back(each.number);
  return list;
}

int save_blend(RenderJob& job, const BlenderOptions& options) {
  job.blend = fs::absolute(job.blend);
  create_output_folder(job.blend.parent_path());
  if (!run_blender(job, options)) return interrupted_code();
  say(stdout, fmt::format("{} holds {} frames, camera, light and materials\n", job.blend.string(), job.frames.size()));
  return done;
}

int film_of(const RenderJob& job, const std::vector<SurfaceFile>& frames, double rate, const fs::path& film) {
  std::vector<fs::path> pictures;
  for (const SurfaceFile& each : frames) pictures.push_back(picture_of(job.output, each.number));
  switch (make_film(pictures, rate, film)) {
    case FilmEnd::done:
      say(stdout, fmt::format("{}: {} frames at {:g} a second\n", film.string(), frames.size(), rate));
      return done;
    case FilmEnd::missing:
      say(stderr, "a film takes ffmpeg, and there is no program `ffmpeg`; on Debian: apt install ffmpeg\n");
      return run_failed;
    case FilmEnd::interrupted:
      break;
  }
  return interrupted_code();
}

int render(const RenderOptions& options) {
  const fs::path results = options.results;
  const Surfaces surfaces = read_surfaces(results);
  const std::vector<SurfaceFile> frames = chosen(surfaces, options.frames);
  RenderJob job;
  job.settings = read_render_settings(results, overrides_of(options));
  check_solids(job.settings, surfaces.solids);
  job.surfaces = surfaces.list.parent_path();
  job.output = options.output.empty() ? results / "render" : fs::path(options.output);
  job.blend = options.blend;
  job.frames = numbers(frames);
  const FolderLock lock(job.output);
  if (!lock.warning().empty()) say(stderr, "warning: " + lock.warning() + "\n");
  const BlenderOptions how{options.threads, progress_style(options.progress)};
  if (!job.blend.empty()) return save_blend(job, how);

  keep_settings(job.output, job.settings, options.again);
  std::vector<SurfaceFile> missing = frames;
  if (!options.again) std::erase_if(missing, [&](const auto& each) { return is_rendered(job.output, each); });
  job.frames = numbers(missing);
  if (!missing.empty() && !run_blender(job, how)) {
    say(stderr, fmt::format("interrupted; the frames that are done are in {}, the same command goes on with the rest\n",
                            job.output.string()));
    return interrupted_code();
  }
  say(stdout, fmt::format("{} frames rendered, {} were there; they are in {}\n", missing.size(),
                          frames.size() - missing.size(), job.output.string()));
  if (options.no_video || (frames.size() == 1 && options.video.empty())) return done;
  const double rate = options.rate > 0 ? options.rate : true_rate(surfaces);
  return film_of(job, frames, rate, options.video.empty() ? job.output / "film.mp4" : fs::path(options.video));
}

template <Worded T>
std::string all_words() {
  return fmt::format("{}", fmt::join(Words<T>::words, ", "));
}

void add_looks(CLI::App& command, RenderOptions& options) {
  command.add_option("--look", options.look, "the liquid: " + all_words<LiquidLook>())->type_name("NAME");
  command.add_option("--background", options.background, all_words<Backdrop>())->type_name("NAME");
  command.add_option("--camera", options.camera, "such as elevation=40, target=[0,0,1], position=[5,0,2], zoom=1.5")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--size", options.size, "pixels, such as 640x360")->type_name("WxH");
  command.add_option("--samples", options.samples, "rays for each pixel")->type_name("N");
  command.add_option("--set", options.overrides, "any value of the scene's group \"render\", e.g. shutter=0")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace

void add_render(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      program.add_subcommand("render", "Render the surfaces that `sessile mesh` made into a film, with Blender.");
  command->add_option("results", options->results, "folder of results")->required()->type_name("DIR");
  command->add_option("-o,--output", options->output, "folder for the pictures (default: DIR/render)")
      ->type_name("DIR");
  command->add_option("--frames", options->frames, "frames by their place: 10:20, ::5, 0,3,-1")->type_name("LIST");
  add_looks(*command, *options);
  command->add_flag("--again", options->again, "also frames that are rendered already");
  command->add_option("--fps", options->rate, "frames of the film per second (default: as fast as the liquid was)")
      ->type_name("N")
      ->check(CLI::Range(0.01, 1000.0));
  command->add_option("--video", options->video, "file for the film (default: film.mp4 beside the pictures)")
      ->type_name("FILE");
  command->add_flag("--no-video", options->no_video, "pictures only");
  command->add_option("--blend", options->blend, "save the frames as a Blender file instead of rendering them")
      ->type_name("FILE");
  command->add_option("--threads", options->threads, "processors for Blender (default: all)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->add_option("--progress", options->progress, "how progress is shown")
      ->check(CLI::IsMember({"auto", "plain", "json", "none"}))
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = render(*options); });
}

}  // namespace sessile::app
