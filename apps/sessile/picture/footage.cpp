#include "picture/footage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/selection.h"
#include "prepare.h"
#include "progress.h"
#include "sessile/core/error.h"
#include "sessile/measure/health.h"
#include "sessile/surface/reconstruct.h"
#include "shown.h"
#include "signals.h"

namespace sessile::app {
namespace {

constexpr std::size_t samples = 16;

bool wants_surface(const PictureOptions& options) { return options.look == draw::Look::surface; }

/// Those that the scene's own surfaces have; the usual ones without any.
SurfaceSettings surface_settings(const Scene& scene) {
  return scene.output.surface ? static_cast<const SurfaceSettings&>(*scene.output.surface) : SurfaceSettings();
}

/// Time of each frame that a run of the scene would write.
std::vector<double> frame_times(const Scene& scene) {
  const double interval = scene.output.frame_interval, end = scene.time.end;
  std::vector<double> times;
  for (double k = 0; k * interval < (1 - 1e-9) * end; ++k) times.push_back(k * interval);
  times.push_back(end);
  return times;
}

/// Time of each picture of a video of the scene.
std::vector<double> video_times(const Scene& scene, double frames_per_second) {
  std::vector<double> times;
  for (double k = 0; k <= scene.time.end * frames_per_second + 1e-6; ++k) times.push_back(k / frames_per_second);
  return times;
}

std::vector<double> chosen_times(const Scene& scene, const PictureOptions& options) {
  if (!options.video.empty()) {
    if (!options.frames.empty()) {
      throw Error(
          "a video of a scene shows all of it; --time says where it ends, --frames chooses of a folder's frames");
    }
    return video_times(scene, options.frames_per_second);
  }
  if (!options.times.empty()) return options.times;
  if (options.frames.empty()) return {scene.time.end};
  const std::vector<double> all = frame_times(scene);
  std::vector<double> times;
  for (const std::size_t place : selected(options.frames, all.size())) times.push_back(all[place]);
  return times;
}

/// Which frames of a folder were asked for.
std::vector<ResultFrame> chosen_frames(const Results& results, const PictureOptions& options) {
  const bool video = !options.video.empty();
  std::vector<ResultFrame> frames;
  if (!options.times.empty() && video) {
    for (const ResultFrame& frame : results.frames) {
      if (frame.time <= options.times.front()) frames.push_back(frame);
    }
    return frames;
  }
  for (const double time : options.times) frames.push_back(frame_at(results, time));
  if (!options.times.empty()) return frames;
  const std::string list = !options.frames.empty() ? options.frames : video ? ":" : "-1";
  for (const std::size_t place : selected(list, results.frames.size())) frames.push_back(results.frames[place]);
  if (frames.empty()) throw Error(fmt::format("--frames {} chooses none of {} frames", list, results.frames.size()));
  return frames;
}

/// The scene with what the options put over it.
ResolvedScene scene_of(const PictureOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (!options.times.empty())
    overrides.push_back(fmt::format("time.end={:.17g}", std::max(options.times.back(), 1e-9)));
  return read_runnable_scene(options.source, overrides, options.places);
}

draw::Moment state_of(const Simulation& simulation, const PictureOptions& options, const draw::Stage& stage) {
  draw::Moment moment = moment_of(simulation, options.field, stage);
  if (wants_surface(options)) {
    moment.surface = reconstruct(take_snapshot(simulation, {}), stage.spacing, surface_settings(simulation.scene()));
  }
  return moment;
}

}  // namespace

FolderFootage::FolderFootage(const PictureOptions& options)
    : options_(options),
      results_(open_results(options.source)),
      stage_(stage_of(results_.scene)),
      frames_(chosen_frames(results_, options)) {
  if (!options.overrides.empty()) throw Error("--set is for scenes: what a folder holds has been run");
  read(frames_.front(), false);  // a field that is not there shows now, not after half a video
}

draw::Moment FolderFootage::read(const ResultFrame& frame, bool with_surface) const {
  const Snapshot snapshot = read_frame(frame.file);
  draw::Moment moment = moment_of(snapshot, options_.field, stage_);
  if (with_surface) moment.surface = reconstruct(snapshot, stage_.spacing, surface_settings(results_.scene));
  return moment;
}

void FolderFootage::play(const TakeMoment& take) const {
  for (const ResultFrame& frame : frames_) {
    if (stop_asked()) return;
    take(read(frame, wants_surface(options_)));
  }
}

std::vector<draw::Moment> FolderFootage::sample() const {
  std::vector<draw::Moment> moments;
  const std::size_t n = frames_.size(), wanted = std::min(samples, n);
  for (std::size_t k = 0; k < wanted; ++k) {
    moments.push_back(read(frames_[wanted > 1 ? k * (n - 1) / (wanted - 1) : 0], false));
  }
  return moments;
}

SceneFootage::SceneFootage(const PictureOptions& options)
    : options_(options),
      scene_(scene_of(options)),
      stage_(stage_of(scene_.scene)),
      times_(chosen_times(scene_.scene, options)),
      simulation_(set_up(scene_, options.source)) {
  moment_of(simulation_, options.field, stage_);  // a field that is not there shows now
}

namespace {

/// One step, judged as `sessile run` judges it. Throws RunError when it goes wrong: there is nothing to show then.
void step_well(Simulation& simulation, Health& health) {
  StabilitySettings settings = simulation.scene().stability;
  settings.on_fault = OnFault::go_back;  // which a picture does not do, so that it is no advice
  std::vector<RunFault> found;
  try {
    simulation.step();
    found = health.look(simulation);
  } catch (const RunError&) {
    if (simulation.health().not_finite.count == 0) throw;  // of another kind, which says itself what helps
    found = health.look(simulation);
  }
  for (const RunFault& fault : found) {
    if (fault.counts) throw RunError(fmt::format("{}. {}", fault.message, advice(fault, settings)));
  }
}

}  // namespace

void SceneFootage::play(const TakeMoment& take) {
  Health health(simulation_.scene().stability);
  Progress progress(progress_style(options_.progress), "", simulation_);
  for (const double time : times_) {
    while (simulation_.time() < time * (1 - 1e-9) && !stop_asked()) {
      step_well(simulation_, health);
      progress.update(simulation_);
    }
    if (stop_asked()) break;
    take(state_of(simulation_, options_, stage_));
  }
  if (simulation_.totals().steps > 0) progress.finish(simulation_);
}

}  // namespace sessile::app
