#include "surface_recorder.h"

#include <string>
#include <utility>

#include "sessile/output/snapshot.h"
#include "sessile/surface/reconstruct.h"

namespace sessile::app {
namespace {

double interval_of(const Output& output) {
  return output.surface ? output.surface->interval.value_or(output.frame_interval) : output.frame_interval;
}

/// How a run makes its surfaces.
SurfacePlan plan_of(const Scene& scene) {
  const SurfaceOutput& asked = *scene.output.surface;
  return {static_cast<const SurfaceSettings&>(asked), asked.formats, scene.spacing, 1 / interval_of(scene.output)};
}

bool makes_files(const Scene& scene) { return scene.output.surface && !scene.output.surface->formats.empty(); }

}  // namespace

void require_surfaces(const std::filesystem::path& results, const Scene& scene, const std::vector<double>& times) {
  if (makes_files(scene)) require_surfaces(results / surface_folder_name, results, scene, plan_of(scene), times);
}

SurfaceRecorder::SurfaceRecorder(const std::filesystem::path& results, const Scene& scene, std::vector<double> times)
    : asked_(scene.output.surface),
      schedule_(interval_of(scene.output), times.empty() ? std::nullopt : std::optional(times.back())),
      times_(std::move(times)) {
  if (makes_files(scene)) folder_.emplace(results / surface_folder_name, results, scene, plan_of(scene), times_);
}

void SurfaceRecorder::record(const Simulation& simulation) {
  if (folder_ && schedule_.due(simulation.time())) write(simulation);
}

void SurfaceRecorder::write(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  schedule_.done(simulation.time());
  const SurfaceMesh mesh = reconstruct(take_snapshot(simulation, scene.output.columns), scene.spacing, *asked_);
  folder_->write(static_cast<std::int64_t>(times_.size()), mesh);
  times_.push_back(simulation.time());
  measures_ = {surface_area(mesh), enclosed_volume(mesh)};
  measured_time_ = simulation.time();
}

std::optional<SurfaceMeasures> SurfaceRecorder::measure(const Simulation& simulation) {
  if (!asked_ || !asked_->stats) return {};
  if (measured_time_ < simulation.time()) {
    const std::vector<std::string> no_columns;
    const SurfaceMesh mesh = reconstruct(take_snapshot(simulation, no_columns), simulation.scene().spacing, *asked_);
    measures_ = {surface_area(mesh), enclosed_volume(mesh)};
    measured_time_ = simulation.time();
  }
  return measures_;
}

void SurfaceRecorder::finish(const Simulation& simulation, bool failed) {
  if (!folder_) return;
  if (!failed && !schedule_.is_done(simulation.time())) write(simulation);
  folder_->finish();
}

}  // namespace sessile::app
