#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <tuple>

#include "sessile/core/fields.h"

namespace sessile {

/// What a run does when a step went wrong.
enum class OnFault { stop, go_back };

template <>
struct Words<OnFault> {
  static constexpr std::array<std::string_view, 2> words{"stop", "go_back"};
};

/// What counts as a fault of a run, and what then happens. Numbers that are not finite and a collapse always count.
struct StabilitySettings {
  OnFault on_fault = OnFault::stop;
  int retries = 5;
  double dt_factor = 0.5;
  std::optional<double> hold;
  std::optional<double> keep_interval;
  double collapse_limit = 30;
  bool speed = true;
  double speed_limit = 1;
  bool density = true;
  double density_limit = 0.01;
  int density_steps = 100;
  bool escapes = true;
  bool passages = true;

  static constexpr auto fields() {
    using T = StabilitySettings;
    return std::tuple{
        field(&T::on_fault, "on_fault",
              "stop: the run ends with a dump; go_back: it goes on from the last good state in shorter steps"),
        field(&T::retries, "retries", "", between(1, 50), "going back so often in a row; then the run stops"),
        field(&T::dt_factor, "dt_factor", "", between(0.05, 0.95),
              "factor on the time step, for each time in a row that the run went back"),
        derived(field(&T::hold, "hold", "s", positive, "time beyond the fault for which steps stay that short"),
                "100 of the steps that failed"),
        derived(field(&T::keep_interval, "keep_interval", "s", positive, "time between the states that are kept"),
                "the frame interval"),
        field(&T::collapse_limit, "collapse_limit", "", at_least(2),
              "rest densities above which the liquid has collapsed"),
        field(&T::speed, "speed", "whether it is a fault that a step throws a particle beyond speed_limit"),
        field(&T::speed_limit, "speed_limit", "", positive,
              "support radii that a step may throw a particle off the way of its velocity"),
        field(&T::density, "density", "whether it is a fault that the liquid stays compressed beyond density_limit"),
        field(&T::density_limit, "density_limit", "", positive,
              "average compression that counts, when solves in a row end above their error without getting better; "
              "five times "
              "it of solves that say they reached it"),
        field(&T::density_steps, "density_steps", "", at_least(2), "so many steps in a row"),
        field(&T::escapes, "escapes",
              "whether it is a fault that a particle passes through a container or a closed face of the domain; else a "
              "warning"),
        field(&T::passages, "passages", "the same of the other solids"),
    };
  }
};

}  // namespace sessile
