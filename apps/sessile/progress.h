#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "sessile/simulation.h"

namespace sessile::app {

/// How progress is shown: a line that renews itself on a terminal, plain lines elsewhere, JSON lines, or nothing.
enum class ProgressStyle { terminal, plain, json, none };

/// "auto", "plain", "json" or "none"; auto is `terminal` when standard error is one.
ProgressStyle progress_style(const std::string& word);

/// A span of time for people: `12 s`, `3 min 05 s`, `2 h 10 min`.
std::string duration_text(double seconds);

/// Shows how far a run is: on standard error for people, on standard output as JSON lines for programs.
class Progress {
 public:
  /// `run` names the run where a program makes several.
  Progress(ProgressStyle style, std::string run, const Simulation& simulation);
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Called after each step; shows something only every so often.
  void update(const Simulation& simulation);

  /// Shows the last state and ends the line.
  void finish(const Simulation& simulation);

  /// A warning on a line of its own; as JSON where progress is; nothing where progress is none.
  void warn(const std::string& message);

 private:
  using Clock = std::chrono::steady_clock;
  void show(const Simulation& simulation);
  void finish();

  ProgressStyle style_;
  std::string run_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = start_;
  double first_time_;  // from where this run goes on [s]
  std::int64_t first_step_;
  bool line_open_ = false;
};

/// Shows how far work on a number of like things is, such as frames; the same styles.
class CountProgress {
 public:
  /// `things` names them for people, in the plural: "frames".
  CountProgress(ProgressStyle style, std::string things, std::int64_t total)
      : style_(style), things_(std::move(things)), total_(total) {}
  ~CountProgress();
  CountProgress(const CountProgress&) = delete;
  CountProgress& operator=(const CountProgress&) = delete;

  /// Called after each of them; `note` says something of the last one: "120034 triangles".
  void update(std::int64_t done, const std::string& note);

 private:
  using Clock = std::chrono::steady_clock;

  ProgressStyle style_;
  std::string things_;
  std::int64_t total_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = start_ - std::chrono::hours(1);
  bool line_open_ = false;
};

}  // namespace sessile::app
