#include "recorder.h"

#include <chrono>
#include <exception>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "sessile/core/error.h"
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

/// Makes the folder, and takes out the results of an earlier run into it: left beside fewer new ones they would pass
/// for theirs. stats.csv is begun anew in any case.
const std::filesystem::path& prepared(const std::filesystem::path& folder) {
  create_output_folder(folder);
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
      stats_(folder / "stats.csv", simulation.walls().labels),
      frame_interval_(simulation.scene().output.frame_interval),
      stats_interval_(simulation.scene().output.stats_interval.value_or(0.1 * frame_interval_)) {
  // At the start already, so that the results of a run that goes on, or was killed, can be opened.
  write_whole(folder_ / "scene.json", to_json(simulation.scene()));
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
  if (simulation.scene().output.formats.empty()) return;
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
  const auto start = std::chrono::steady_clock::now();
  if (facts.status != RunStatus::failed) {
    if (frame_time_ < simulation.time()) write_frame(simulation);
    if (stats_time_ < simulation.time()) write_stats(simulation);
  }
  std::exception_ptr close_error;
  try {
    output_seconds_ += seconds_of([&] { frames_.close(); });
  } catch (const FileError& e) {
    // The summary may still find room, and should say how the run ended.
    close_error = std::current_exception();
    facts.status = RunStatus::failed;
    if (facts.message.empty()) facts.message = e.what();
  }
  facts.wall_time += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  facts.output_time = output_seconds_;
  facts.measures_time = measure_seconds_;
  facts.writer_time = frames_.seconds();
  facts.frames = frames_.frames_written();
  if (close_error) {
    try {
      write_summary(folder_ / "summary.json", facts, simulation_facts(simulation));
    } catch (const FileError&) {
      // The first error is the one to report.
    }
    std::rethrow_exception(close_error);
  }
  write_summary(folder_ / "summary.json", facts, simulation_facts(simulation));
}

}  // namespace sessile::app
