#include "progress.h"

#include <fmt/format.h>
#include <json/json.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "say.h"

namespace sessile::app {
namespace {

/// A line of JSON for a program that reads along.
void print_line(const Json::Value& line) {
  Json::StreamWriterBuilder compact;
  compact["indentation"] = "";
  say(stdout, Json::writeString(compact, line) + "\n");
}

}  // namespace

std::string duration_text(double seconds) {
  constexpr double longest = 1e15;  // beyond it nobody waits, and somewhere no integer holds it
  const auto whole = std::llround(seconds >= 0 ? std::min(seconds, longest) : 0.0);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

ProgressStyle progress_style(const std::string& word) {
  if (word == "plain") return ProgressStyle::plain;
  if (word == "json") return ProgressStyle::json;
  if (word == "none") return ProgressStyle::none;
  return isatty(STDERR_FILENO) ? ProgressStyle::terminal : ProgressStyle::plain;
}

Progress::Progress(ProgressStyle style, std::string run, const Simulation& simulation)
    : style_(style), run_(std::move(run)), first_time_(simulation.time()), first_step_(simulation.totals().steps) {}

void Progress::update(const Simulation& simulation) {
  if (style_ == ProgressStyle::none) return;
  const std::chrono::duration<double> pause = Clock::now() - shown_;
  if (pause.count() < (style_ == ProgressStyle::plain ? 2.0 : 0.2)) return;
  show(simulation);
}

void Progress::show(const Simulation& simulation) {
  shown_ = Clock::now();
  const double wall = std::chrono::duration<double>(shown_ - start_).count();
  const double end = simulation.scene().time.end, time = simulation.time();
  const double share = std::min(1.0, time / end);
  const auto steps = static_cast<double>(simulation.totals().steps - first_step_);
  const double rate = wall > 0 ? steps / wall : 0;
  const double left = time > first_time_ ? wall * std::max(0.0, end - time) / (time - first_time_) : 0;
  const StepReport& last = simulation.last_step();
  if (style_ == ProgressStyle::json) {
    Json::Value line;
    if (!run_.empty()) line["run"] = run_;
    line["time"] = time;
    line["end"] = end;
    line["step"] = static_cast<Json::Int64>(simulation.totals().steps);
    line["dt"] = last.dt;
    line["bound"] = std::string(last.bound);
    line["iterations"] = last.iterations;
    line["predicted_density_error"] = last.predicted_error;
    line["particles"] = static_cast<Json::UInt64>(simulation.particles().size());
    line["steps_per_second"] = rate;
    line["seconds_left"] = left;
    print_line(line);
    return;
  }
  const std::string line = (run_.empty() ? "" : run_ + "  ") +
                           fmt::format(
                               "{:5.1f} %  t {:.4f} of {:g} s  step {}  dt {:.3g} s ({})  {} iterations  {} particles  "
                               "{:.1f} steps/s  {} left",
                               100 * share, time, end, simulation.totals().steps, last.dt, last.bound, last.iterations,
                               simulation.particles().size(), rate, duration_text(left));
  if (style_ == ProgressStyle::terminal) {
    say(stderr, "\r\033[K" + line);
    line_open_ = true;
  } else {
    say(stderr, line + "\n");
  }
}

void Progress::finish(const Simulation& simulation) {
  if (style_ != ProgressStyle::none) show(simulation);
  finish();
}

void Progress::finish() {
  if (line_open_) say(stderr, "\n");
  line_open_ = false;
}

void Progress::warn(const std::string& message) {
  if (style_ == ProgressStyle::none) return;  // the lines at the end and the summary count what was warned of
  if (style_ == ProgressStyle::json) {
    Json::Value line;
    if (!run_.empty()) line["run"] = run_;
    line["warning"] = message;
    print_line(line);
    return;
  }
  finish();
  say(stderr, "warning: " + (run_.empty() ? "" : run_ + " ") + message + "\n");
}

CountProgress::~CountProgress() {
  if (line_open_) say(stderr, "\n");
}

void CountProgress::update(std::int64_t done, const std::string& note) {
  if (style_ == ProgressStyle::none) return;
  const auto now = Clock::now();
  const std::chrono::duration<double> pause = now - shown_, wall = now - start_;
  if (done < total_ && pause.count() < (style_ == ProgressStyle::plain ? 2.0 : 0.2)) return;
  shown_ = now;
  const double each = done > 0 ? wall.count() / static_cast<double>(done) : 0;
  const double left = each * static_cast<double>(total_ - done);
  if (style_ == ProgressStyle::json) {
    Json::Value line;
    line["done"] = static_cast<Json::Int64>(done);
    line["total"] = static_cast<Json::Int64>(total_);
    line["note"] = note;
    line["seconds_each"] = each;
    line["seconds_left"] = left;
    print_line(line);
    return;
  }
  const std::string line =
      fmt::format("{:5.1f} %  {} of {} {}  {}  {:.2f} s each  {} left",
                  100 * static_cast<double>(done) / static_cast<double>(std::max<std::int64_t>(total_, 1)), done,
                  total_, things_, note, each, duration_text(left));
  line_open_ = style_ == ProgressStyle::terminal;
  say(stderr, line_open_ ? "\r\033[K" + line : line + "\n");
}

}  // namespace sessile::app
