#pragma once

#include <cstdint>
#include <string>

#include "sessile/measure/health.h"

namespace sessile::app {

/// What a run that may go back remembers of having done so: the part of a checkpoint that makes a resumed run go back,
/// and stop, where the undisturbed one does.
struct StabilityState {
  HealthState health;
  double dt_limit = 0;            ///< no step is longer [s]; 0: as the scene says
  double until = 0;               ///< time to which that holds [s]
  std::int64_t retries = 0;       ///< in a row
  std::int64_t went_back = 0;     ///< in all
  std::int64_t undone_steps = 0;  ///< that going back took back
  std::string last_fault;         ///< why it last did
};

}  // namespace sessile::app
