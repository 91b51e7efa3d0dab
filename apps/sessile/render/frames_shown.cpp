#include "frames_shown.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "say.h"

namespace sessile::app {
namespace {

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

void FramesShown::done() {
  ++done_;
  if (style_ == ProgressStyle::none) return;
  const double each = std::chrono::duration<double>(Clock::now() - start_).count() / static_cast<double>(done_);
  std::string text = fmt::format("frame {} of {}, {} a frame", done_, frames_, duration_text(each));
  if (done_ < frames_) text += fmt::format(", {} left", duration_text(each * static_cast<double>(frames_ - done_)));
  const bool terminal = style_ == ProgressStyle::terminal;
  say(stderr, terminal ? fmt::format("\r\x1b[K{}", text) : text + "\n");
  line_open_ = terminal;
}

void FramesShown::finish() {
  if (line_open_) say(stderr, "\n");
  line_open_ = false;
}

}  // namespace sessile::app
