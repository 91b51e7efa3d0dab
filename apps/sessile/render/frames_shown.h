#pragma once

#include <chrono>
#include <cstddef>

#include "progress.h"

namespace sessile::app {

/// Shows on standard error how many frames are done and how long the rest will take.
class FramesShown {
 public:
  FramesShown(std::size_t frames, ProgressStyle style) : frames_(frames), style_(style) {}
  void done();    ///< one more
  void finish();  ///< ends the line

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t frames_, done_ = 0;
  ProgressStyle style_;
  Clock::time_point start_ = Clock::now();
  bool line_open_ = false;
};

}  // namespace sessile::app
