#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sessile/core/fields.h"
#include "sessile/core/vec.h"
#include "sessile/scene/stability_settings.h"

namespace sessile {

class Simulation;

/// How a run can go wrong, the worst first.
enum class RunFaultKind { not_finite, collapse, speed, density, escape, passage };

template <>
struct Words<RunFaultKind> {
  static constexpr std::array<std::string_view, 6> words{"not_finite", "collapse", "speed",
                                                         "density",    "escape",   "passage"};
};

/// One thing that went wrong in a step: what, when, where.
struct RunFault {
  RunFaultKind kind = RunFaultKind::not_finite;
  bool counts = true;            ///< whether it is a fault by the scene's settings; else it is only told
  double time = 0;               ///< after the step [s]
  std::int64_t step = 0;         ///< its number, from 1
  double dt = 0;                 ///< [s]
  std::string_view bound;        ///< what set dt
  std::string_view overruled;    ///< the stability bound that dt exceeds, or ""
  std::int64_t count = 0;        ///< particles it happened to in that step
  std::int64_t particle = -1;    ///< id of the first of them; of the fastest, of the most compressed
  Vec3d position{}, velocity{};  ///< of that one [m], [m/s]
  std::string message;           ///< a sentence with all of it
};

/// What Health remembers from step to step.
struct HealthState {
  std::int64_t compressed_steps = 0;       ///< in a row, of the stretch that is watched now
  double first_half = 0, second_half = 0;  ///< sums of the average compression over its halves
};

/// Watches a run for what a step that is too long does to it:
///   not_finite  a position, velocity or pressure is not finite
///   collapse    a density is above collapse_limit rest densities. Neighbours grow with it, to the end
///               of time and memory
///   speed       a step throws a particle more than speed_limit support radii off the way of its velocity. What acts
///               on it reaches no farther than one of them: what the step reckoned with no longer holds there. A step
///               within its bounds throws one by 0.06 dx, and pressure that stops it or parts a pair by about dx.
///               So is a way of more than that, |v| dt, in a step that dt_min made longer than the bounds ask for
///   density     in density_steps steps in a row the solve ended above its error with an average compression above
///               density_limit at the new positions, on the later half of them no less than on the first. A solve that
///               says it reached its error counts as well when the compression is above five times density_limit: what
///               it predicts then has little to do with the liquid
///   escape      a particle passes through a container or a closed face of the domain
///   passage     one passes through another solid
class Health {
 public:
  explicit Health(const StabilitySettings& settings, const HealthState& state = {})
      : settings_(settings), state_(state) {}

  /// Called after every step, of one that threw too: all that went wrong in it, the worst first.
  std::vector<RunFault> look(const Simulation& simulation);

  /// Whether the last step may be the beginning of a fault: no state to go back to.
  bool doubtful() const { return state_.compressed_steps > 0; }

  const HealthState& state() const { return state_; }

 private:
  bool stays_compressed(const Simulation& simulation);

  StabilitySettings settings_;
  HealthState state_;
};

/// What can be done about it, as a sentence.
std::string advice(const RunFault& fault, const StabilitySettings& settings);

/// The change that a run may go on with from the state before: `time.fixed_dt=0.01`, `stability.passages=false`.
std::string way_on(const RunFault& fault);

}  // namespace sessile
