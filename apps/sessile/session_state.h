#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stability_state.h"

namespace sessile::app {

/// What a run has written so far, and how long it took: the part of a checkpoint that is the program's own. Files grow
/// from here when the run is resumed; what was written after it is taken back.
struct SessionState {
  std::vector<double> frame_times;    ///< of all frames [s]
  std::vector<double> surface_times;  ///< of all surfaces [s]
  std::uint64_t stats_bytes = 0;      ///< length of stats.csv
  std::optional<double> stats_time;   ///< of its last line [s]
  std::optional<double> frame_due;    ///< when frames were last due [s]; formats may be none
  double wall_time = 0;               ///< of the run [s]
  double output_time = 0;             ///< of that, waiting for output [s]
  double measures_time = 0;           ///< of that, measuring [s]
  double writer_time = 0;             ///< of the writer's own thread [s]
  StabilityState stability{};
};

inline constexpr std::int64_t most_steps = std::int64_t{1} << 62;

/// As JSON, numbers exact.
std::string session_json(const SessionState& state);

/// Throws Error for what is no such JSON, and for one with more frames than `steps` can have made: one at the start,
/// and one after each.
SessionState session_of(const std::string& json, std::int64_t steps = most_steps);

}  // namespace sessile::app
