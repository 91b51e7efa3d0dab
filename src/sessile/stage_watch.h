#pragma once

#include <chrono>

#include "sessile/simulation_state.h"

namespace sessile {

/// Adds the wall time of its own life to a stage.
class StageWatch {
 public:
  StageWatch(StageTimes& times, double StageTimes::*stage) : times_(times), stage_(stage) {}
  ~StageWatch() {
    times_.*stage_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    times_.clock_reads += 2;
  }
  StageWatch(const StageWatch&) = delete;
  StageWatch& operator=(const StageWatch&) = delete;

 private:
  StageTimes& times_;
  double StageTimes::*stage_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace sessile
