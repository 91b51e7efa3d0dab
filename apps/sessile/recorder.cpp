#include "recorder.h"

#include <chrono>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "sessile/core/error.h"
#include "sessile/measure/diagnostics.h"
#include "sessile/output/file.h"
#include "sessile/output/frames.h"
#include "sessile/output/snapshot.h"
#include "sessile/scene/describe.h"

namespace sessile::app {
namespace {

template <class F>
double seconds_of(F&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Whether a file is of an earlier run, or half a one that a killed run left behind.
bool is_result(std::string name) {
  constexpr std::string_view part = ".part";
  if (name.starts_with('.') && name.ends_with(part)) name = name.substr(1, name.size() - 1 - part.size());
  if (name == "frames.pvd" || name == "scene.json" || name == "summary.json") return true;
  const auto dot = name.rfind('.');
  const bool known = dot != std::string::npos && find_frame_format(name.substr(dot + 1)) != nullptr;
  return known && (name.starts_with("frame_") || name.starts_with("solids."));
}

bool asks_for_area(const Scene& scene) { return scene.output.surface && scene.output.surface->stats; }

/// Makes the folder, and takes out the results of an earlier run into it: left beside fewer new ones they would pass
/// for theirs. stats.csv is begun anew in any case.
const std::filesystem::path& prepared(const std::filesystem::path& folder) {
  create_output_folder(folder);
  remove_surfaces(folder / surface_folder_name);
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (is_result(entry.path().filename().string())) old.push_back(entry.path());
  }
  for (const auto& file : old) {
    std::error_code error;
    if (!std::filesystem::remove(file, error) && error) {
      throw FileError(file.string() + ": cannot remove this result of an earlier run: " + error.message());
    }
  }
  return folder;
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& folder, const Simulation& simulation)
    : folder_(prepared(folder)),
      frames_(folder, simulation.scene().output.formats),
      stats_(folder / "stats.csv", simulation.walls().labels, asks_for_area(simulation.scene())),
      surfaces_(folder, simulation.scene()),
      frame_schedule_(simulation.scene().output.frame_interval),
      stats_schedule_(
          simulation.scene().output.stats_interval.value_or(0.1 * simulation.scene().output.frame_interval)) {
  // At the start already, so that the results of a run that goes on, or was killed, can be opened.
  write_whole(folder_ / "scene.json", to_json(simulation.scene()));
  output_seconds_ += seconds_of([&] { frames_.write_solids(take_solids(simulation.walls())); });
  record(simulation);
}

void Recorder::record(const Simulation& simulation) {
  if (frame_schedule_.due(simulation.time())) write_frame(simulation);
  output_seconds_ += seconds_of([&] { surfaces_.record(simulation); });
  if (stats_schedule_.due(simulation.time())) write_stats(simulation);
}

void Recorder::write_frame(const Simulation& simulation) {
  frame_schedule_.done(simulation.time());
  if (simulation.scene().output.formats.empty()) return;
  output_seconds_ += seconds_of([&] { frames_.push(take_snapshot(simulation, simulation.scene().output.columns)); });
}

void Recorder::write_stats(const Simulation& simulation) {
  stats_schedule_.done(simulation.time());
  Diagnostics measured;
  std::optional<SurfaceMeasures> surface;
  measure_seconds_ += seconds_of([&] {
    measured = measure(simulation);
    surface = surfaces_.measure(simulation);
  });
  output_seconds_ += seconds_of([&] { stats_.write(simulation, measured, surface); });
}

void Recorder::finish(const Simulation& simulation, RunFacts facts) {
  const auto start = std::chrono::steady_clock::now();
  if (facts.status != RunStatus::failed) {
    if (!frame_schedule_.is_done(simulation.time())) write_frame(simulation);
    if (!stats_schedule_.is_done(simulation.time())) write_stats(simulation);
  }
  const bool failed = facts.status == RunStatus::failed;
  std::exception_ptr first_error;
  const auto attempt = [&](auto&& last_work) {
    try {
      output_seconds_ += seconds_of(last_work);
    } catch (const Error& e) {
      // The summary may still find room, and should say how the run ended.
      if (!first_error) first_error = std::current_exception();
      facts.status = RunStatus::failed;
      if (facts.message.empty()) facts.message = e.what();
    }
  };
  attempt([&] { surfaces_.finish(simulation, failed); });
  attempt([&] { frames_.close(); });
  facts.wall_time += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  facts.output_time = output_seconds_;
  facts.measures_time = measure_seconds_;
  facts.writer_time = frames_.seconds();
  facts.frames = frames_.frames_written();
  if (first_error) {
    try {
      write_summary(folder_ / "summary.json", facts, simulation_facts(simulation));
    } catch (const FileError&) {
      // The first error is the one to report.
    }
    std::rethrow_exception(first_error);
  }
  write_summary(folder_ / "summary.json", facts, simulation_facts(simulation));
}

}  // namespace sessile::app
