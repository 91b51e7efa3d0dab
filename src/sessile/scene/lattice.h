#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "sessile/core/error.h"

namespace sessile {

/// Most particles or samples: they are numbered by int32.
inline constexpr double most_points = std::numeric_limits<std::int32_t>::max();

/// How many steps of `spacing` fit into a length, rounded; as a number, because it may be beyond any integer.
inline double steps_in(double length, double spacing) { return std::round(length / spacing); }

/// Place of point k of n points at distance `step`, centred on 0.
inline double centred_place(std::int64_t k, std::int64_t n, double step) {
  return (static_cast<double>(k) - static_cast<double>(n - 1) / 2) * step;
}

/// `body "block" (box)`, or without a label `body (box)`.
inline std::string called(std::string_view what, const std::string& label, std::string_view shape) {
  return std::string(what) + (label.empty() ? "" : " \"" + label + "\"") + " (" + std::string(shape) + ")";
}

/// Throws SceneError when there are more points than can be numbered.
inline void check_count(double count, const std::string& who) {
  if (!(count <= most_points)) throw SceneError(who + ": needs more than 2147483647 points at this spacing");
}

}  // namespace sessile
