#pragma once

#include <cstdint>

#include "sessile/core/vec.h"

namespace sessile {

/// Something that should not happen to a particle in a step: to how many, and to which first, in the order of places.
struct ParticleEvent {
  std::int64_t count = 0;
  std::int64_t id = -1;
  Vec3d position{};  ///< after the step; where it stood before, when the new place is not finite [m]
  Vec3d velocity{};  ///< after the step, where that is finite; else as forces without pressure left it [m/s]
};

/// What can show that the last step went wrong, found in the pass that moves the particles.
struct StepHealth {
  std::int64_t step = 0;     ///< its number, from 1
  double time = 0;           ///< after it [s]
  ParticleEvent not_finite;  ///< position, velocity or pressure
  ParticleEvent escape;   ///< the way crosses a container or a closed face of the domain: out of what holds the liquid
  ParticleEvent passage;  ///< the way crosses another solid's surface into or through it
  int passed = -1;        ///< the solid of `passage`, in the order of Walls::labels
  int escaped = -1;       ///< the solid of `escape`

  /// The particle that the step threw the farthest off the way that its velocity gave it: |v' - v| dt, v' and v being
  /// the velocities after and before it.
  ParticleEvent thrown;
  double throw_length = 0;  ///< of that one [m]
};

}  // namespace sessile
