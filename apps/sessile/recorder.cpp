#include "recorder.h"

#include <chrono>

#include "sessile/output/file.h"
#include "sessile/output/snapshot.h"

namespace sessile::app {
namespace {

template <class F>
double seconds_of(F&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

const std::filesystem::path& made(const std::filesystem::path& folder) {
  create_output_folder(folder);
  return folder;
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& folder, const Simulation& simulation)
    : folder_(made(folder)),
      frames_(folder, simulation.scene().output.formats),
      stats_(folder / "stats.csv", simulation.walls().labels),
      frame_interval_(simulation.scene().output.frame_interval),
      stats_interval_(simulation.scene().output.stats_interval.value_or(0.1 * frame_interval_)) {
  output_seconds_ += seconds_of([&] { frames_.write_solids(take_solids(simulation.walls())); });
  record(simulation);
}

void Recorder::record(const Simulation& simulation) {
  // A hair of an interval forgives the rounding of many added steps.
  const double time = simulation.time();
  if (time >= (static_cast<double>(frames_due_) - 1e-6) * frame_interval_) {
    write_frame(simulation);
    frames_due_ = static_cast<std::int64_t>(time / frame_interval_ + 1e-6) + 1;
  }
  if (stats_interval_ == 0 || time >= (static_cast<double>(stats_due_) - 1e-6) * stats_interval_) {
    write_stats(simulation);
    if (stats_interval_ > 0) stats_due_ = static_cast<std::int64_t>(time / stats_interval_ + 1e-6) + 1;
  }
}

void Recorder::write_frame(const Simulation& simulation) {
  frame_time_ = simulation.time();
  output_seconds_ += seconds_of([&] { frames_.push(take_snapshot(simulation, simulation.scene().output.columns)); });
}

void Recorder::write_stats(const Simulation& simulation) {
  stats_time_ = simulation.time();
  Diagnostics measured;
  measure_seconds_ += seconds_of([&] { measured = measure(simulation); });
  output_seconds_ += seconds_of([&] { stats_.write(simulation, measured); });
}

void Recorder::finish(const Simulation& simulation, RunFacts facts) {
  if (facts.status != RunStatus::failed) {
    if (frame_time_ < simulation.time()) write_frame(simulation);
    if (stats_time_ < simulation.time()) write_stats(simulation);
  }
  output_seconds_ += seconds_of([&] { frames_.close(); });
  facts.output_time = output_seconds_;
  facts.measures_time = measure_seconds_;
  facts.writer_time = frames_.seconds();
  facts.frames = frames_.frames_written();
  write_summary(folder_ / "summary.json", facts, simulation_facts(simulation));
}

}  // namespace sessile::app
