#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

namespace sessile::app {

/// When something falls due that is done at intervals of simulated time: with the first state at or after its time.
class Schedule {
 public:
  /// An interval of 0 s: with every state.
  explicit Schedule(double interval) : interval_(interval) {}

  /// Goes on from when it was last done.
  Schedule(double interval, std::optional<double> last) : interval_(interval) {
    if (last) done(*last);
  }

  /// Whether it is due in a state of this time [s].
  bool due(double time) const {
    // A hair of an interval forgives the rounding of many added steps.
    return interval_ == 0 || time >= (static_cast<double>(served_) - 1e-6) * interval_;
  }

  /// Notes that it has been done for the state of this time [s].
  void done(double time) {
    last_ = time;
    if (interval_ > 0) served_ = static_cast<std::int64_t>(std::min(time / interval_ + 1e-6, most)) + 1;
  }

  /// The time of the state it was last done for [s].
  std::optional<double> last() const { return last_ < 0 ? std::nullopt : std::optional(last_); }

  /// Whether it has been done for the state of this time [s].
  bool is_done(double time) const { return last_ >= time; }

 private:
  static constexpr double most = 9e15;  // intervals: beyond, each state is due

  double interval_;
  double last_ = -1;
  std::int64_t served_ = 0;  // intervals
};

}  // namespace sessile::app
