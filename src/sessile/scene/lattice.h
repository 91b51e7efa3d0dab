#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "sessile/core/bounds.h"
#include "sessile/core/error.h"

namespace sessile {

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

/// Throws SceneError when there are more points than can be numbered; a count that is no number is too many as well.
inline void check_count(double count, const std::string& who) {
  if (!(count <= static_cast<double>(most_indices))) {
    throw SceneError(who + ": needs more than " + std::to_string(most_indices) + " points at this spacing");
  }
}

}  // namespace sessile
