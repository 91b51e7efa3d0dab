#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "commands.h"
#include "progress.h"
#include "run_options.h"
#include "say.h"
#include "selection.h"
#include "sessile/core/error.h"
#include "sessile/scene/read.h"
#include "sessile/scene/spelling.h"
#include "sessile/surface/reconstruct.h"
#include "signals.h"
#include "surface_folder.h"
#include "threads.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct MeshOptions {
  std::string source;  ///< a folder of results, or a frame
  std::string folder;
  std::vector<std::string> formats;
  std::vector<std::string> overrides;
  std::string frames = ":";
  std::optional<double> spacing;
  int threads = 0;
  std::string progress = "auto";
  bool again = false;
};

/// What a call came to.
struct Tally {
  std::size_t made = 0, triangles = 0;
  double reconstruction = 0, writing = 0;  ///< [s]
};

std::string unknown_format(const std::string& word) {
  if (find_surface_format(word) != nullptr) return {};
  std::vector<std::string_view> names;
  for (const SurfaceFormat& format : surface_formats()) names.push_back(format.name);
  return "unknown format " + in_quotes(word) + spelling_hint(word, names, "formats");
}

std::string nothing_there(const std::string& word) {
  std::error_code ignored;
  return fs::exists(word, ignored) ? "" : "there is no file or folder " + in_quotes(word);
}

template <class F>
auto timed(double& seconds, F&& f) {
  const auto start = Clock::now();
  struct Stop {
    double& sum;
    Clock::time_point since;
    ~Stop() { sum += std::chrono::duration<double>(Clock::now() - since).count(); }
  } stop{seconds, start};
  return f();
}

SurfacePlan plan_of(const Scene& scene, const MeshOptions& options) {
  SurfacePlan plan;
  const SurfaceOutput asked = scene.output.surface.value_or(SurfaceOutput{});
  plan.settings = with_overrides(asked, options.overrides);
  if (!asked.formats.empty()) plan.formats = asked.formats;
  if (!options.formats.empty()) plan.formats = options.formats;
  plan.spacing = options.spacing.value_or(scene.spacing);
  plan.frames_per_second = 1 / scene.output.frame_interval;
  return plan;
}

/// `good`: frames that were up to date already.
void print_end(const Tally& tally, std::size_t good, const std::string& place) {
  std::string text = fmt::format("{} frames were up to date already\n", good);
  if (tally.made > 0) {
    const auto n = static_cast<double>(tally.made);
    text = fmt::format("{} frames, {} triangles; a frame took {:.3f} s to reconstruct, {:.3f} s to write\n", tally.made,
                       tally.triangles, tally.reconstruction / n, tally.writing / n);
    if (good > 0) text += fmt::format("{} frames were up to date already\n", good);
  }
  say(stdout, fmt::format("{}surfaces and surface.json are in {}\n", text, place));
}

std::vector<ResultFrame> frames_of(const Results& results, const std::string& selection) {
  std::vector<ResultFrame> frames;
  try {
    for (const std::size_t place : selected(selection, results.frames.size())) frames.push_back(results.frames[place]);
  } catch (const Error& e) {
    throw CLI::ValidationError("--frames", e.what());
  }
  return frames;
}

/// A frame and the formats that it still needs.
struct Due {
  ResultFrame frame;
  std::vector<const SurfaceFormat*> formats;
};

std::vector<Due> due_of(const SurfaceFolder& surfaces, const std::vector<ResultFrame>& frames) {
  std::vector<Due> all;
  for (const ResultFrame& frame : frames) {
    Due due{frame, surfaces.missing(frame)};
    if (!due.formats.empty()) all.push_back(std::move(due));
  }
  return all;
}

/// Makes surfaces until a signal asks for the end.
Tally make(SurfaceFolder& surfaces, const std::vector<Due>& work, ProgressStyle style) {
  Tally tally;
  CountProgress progress(style, "frames", static_cast<std::int64_t>(work.size()));
  for (const Due& due : work) {
    if (stop_asked()) return tally;
    const SurfaceMesh mesh = timed(tally.reconstruction, [&] {
      return reconstruct(read_frame(due.frame.file), surfaces.plan().spacing, surfaces.plan().settings);
    });
    timed(tally.writing, [&] { surfaces.write(due.frame.number, mesh, due.formats); });
    tally.triangles += mesh.triangle_count();
    ++tally.made;
    progress.update(static_cast<std::int64_t>(tally.made), fmt::format("{} triangles", mesh.triangle_count()));
  }
  timed(tally.writing, [&] { surfaces.finish(); });
  return tally;
}

int mesh_folder(const MeshOptions& options) {
  const Results results = open_results(options.source);
  const std::vector<ResultFrame> frames = frames_of(results, options.frames);
  const fs::path folder = options.folder.empty() ? results.folder / surface_folder_name : fs::path(options.folder);
  SurfacePlan plan = plan_of(results.scene, options);
  const ProgressStyle style = progress_style(options.progress);

  heed_signals();
  SurfaceFolder surfaces(folder, results.folder, results.scene, std::move(plan),
                         options.again ? std::optional(std::vector<double>{}) : std::nullopt);
  if (!surfaces.lock().warning().empty()) say(stderr, "warning: " + surfaces.lock().warning() + "\n");
  surfaces.keep_only(results.frames);
  const std::vector<Due> work = due_of(surfaces, frames);
  const Tally tally = make(surfaces, work, style);
  const bool early = tally.made < work.size();
  if (early) say(stderr, fmt::format("interrupted; {} of {} frames are written\n", tally.made, work.size()));
  if (options.progress != "json") print_end(tally, frames.size() - work.size(), folder.string());
  return early ? interrupted_code() : done;
}

/// Where a frame's surface goes: frame_000012.vtp becomes surface_000012.ply, spray.vtp becomes spray_surface.ply.
fs::path surface_of(const fs::path& frame, const fs::path& folder, std::string_view format) {
  constexpr std::string_view prefix = "frame_";
  const std::string stem = frame.stem().string();
  const bool numbered = stem.starts_with(prefix);
  return folder / fmt::format("{}.{}", numbered ? "surface_" + stem.substr(prefix.size()) : stem + "_surface", format);
}

int mesh_frame(const MeshOptions& options) {
  const fs::path file = options.source, beside = file.parent_path().empty() ? fs::path(".") : file.parent_path();
  Scene scene;
  try {
    scene = read_result_scene(beside);
  } catch (const FileError& e) {
    if (!options.spacing) {
      throw FileError(fmt::format("{}; give the distance of the particles: --spacing 0.1", e.what()));
    }
  }
  const SurfacePlan plan = plan_of(scene, options);
  const fs::path folder = options.folder.empty() ? beside : fs::path(options.folder);
  create_output_folder(folder);
  const SurfaceMesh mesh = reconstruct(read_frame(file), plan.spacing, plan.settings);
  std::string files;
  for (const std::string& name : plan.formats) {
    const fs::path to = surface_of(file, folder, name);
    write_surface(to, *find_surface_format(name), mesh, plan, up_of(scene));
    files += (files.empty() ? "" : ", ") + to.string();
  }
  if (options.progress != "json") {
    say(stdout, fmt::format("{} triangles, area {:.6g} m^2, volume {:.6g} m^3: {}\n", mesh.triangle_count(),
                            surface_area(mesh), enclosed_volume(mesh), files));
  }
  return done;
}

int mesh(const MeshOptions& options) {
  use_threads(options.threads);
  return fs::is_directory(options.source) ? mesh_folder(options) : mesh_frame(options);
}

}  // namespace

void add_mesh(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<MeshOptions>();
  CLI::App* command = program.add_subcommand("mesh", "Put a surface around the particles of a run's frames.");
  command->add_option("source", options->source, "folder of `sessile run`, or one frame (.vtp, .ply)")
      ->required()
      ->type_name("DIR|FRAME")
      ->check(nothing_there, "");
  command->add_option("-o,--output", options->folder, "folder for the surfaces (default: DIR/surface; beside FRAME)")
      ->type_name("DIR");
  command->add_option("--format", options->formats, "ply (default), obj, vtp, vdb or usda; as often as wanted")
      ->type_name("NAME")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check(unknown_format, "");
  command->add_option("--set", options->overrides, "put a value over the surface's settings, e.g. cube_size=0.5")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--frames", options->frames, "frames by their place: 10:20, ::5, 0,3,-1")->type_name("LIST");
  command->add_option("--spacing", options->spacing, "distance of the particles, in place of the scene's")
      ->type_name("METRES")
      ->check([](const std::string& word) { return finite_and_positive_in("m", word); }, "");
  command->add_flag("--again", options->again, "make surfaces anew that are up to date");
  command->add_option("--threads", options->threads, "threads to use (default: all)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->add_option("--progress", options->progress, "how progress is shown")
      ->check(CLI::IsMember({"auto", "plain", "json", "none"}))
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = mesh(*options); });
}

}  // namespace sessile::app
