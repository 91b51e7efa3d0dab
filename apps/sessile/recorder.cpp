#include "recorder.h"

#include <chrono>
#include <exception>
#include <optional>
#include <vector>

#include "result_folder.h"
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

bool asks_for_area(const Scene& scene) { return scene.output.surface && scene.output.surface->stats; }

/// stats.csv, new or as long as it was.
StatsWriter stats_of(const std::filesystem::path& folder, const Simulation& simulation,
                     const std::optional<SessionState>& before) {
  const auto file = folder / "stats.csv";
  if (before) return {file, Keep{before->stats_bytes}};
  return {file, simulation.walls().labels, asks_for_area(simulation.scene())};
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& folder, const Simulation& simulation,
                   const std::optional<SessionState>& before)
    : folder_(before ? rewound_folder(folder, *before, simulation.totals().steps) : fresh_folder(folder)),
      frames_(folder, simulation.scene().output.formats, before ? before->frame_times : std::vector<double>{}),
      stats_(stats_of(folder, simulation, before)),
      surfaces_(folder, simulation.scene(), before ? before->surface_times : std::vector<double>{}),
      frame_schedule_(simulation.scene().output.frame_interval, before ? before->frame_due : std::nullopt),
      stats_schedule_(simulation.scene().output.stats_interval.value_or(0.1 * simulation.scene().output.frame_interval),
                      before ? before->stats_time : std::nullopt) {
  // At the start already, so that the results of a run that goes on, or was killed, can be opened.
  write_whole(folder_ / "scene.json", to_json(simulation.scene()));
  if (before) {
    output_seconds_ = before->output_time;
    measure_seconds_ = before->measures_time;
    writer_seconds_before_ = before->writer_time;
    return;
  }
  output_seconds_ += seconds_of([&] { frames_.write_solids(take_solids(simulation.walls())); });
  record(simulation);
}

SessionState Recorder::settle() {
  SessionState state;
  output_seconds_ += seconds_of([&] {
    state.frame_times = frames_.settle();
    state.surface_times = surfaces_.settle();
    state.stats_bytes = stats_.settle();
  });
  state.stats_time = stats_schedule_.last();
  state.frame_due = frame_schedule_.last();
  state.output_time = output_seconds_;
  state.measures_time = measure_seconds_;
  state.writer_time = writer_seconds_before_ + frames_.seconds();
  return state;
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
  facts.writer_time = writer_seconds_before_ + frames_.seconds();
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
