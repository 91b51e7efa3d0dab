#pragma once

#include <optional>
#include <span>

namespace sessile {

/// The search for the largest fixed time step that stays sound, on the series 1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8
/// times powers of ten. A place counts along it: place 0 is 1 s, place -10 is 0.1 s.
struct StepSearch {
  int start = 0;  ///< place of the first trial
  int least = 0;  ///< no trial below
  int most = 0;   ///< no trial above
};

/// A step that was tried.
struct StepTrial {
  int place = 0;
  bool sound = false;
};

/// The time step at a place [s]: the double nearest to its decimals.
double step_at(int place);

/// The greatest place whose step is at most dt, and the least one whose step is at least dt. For dt above 0.
int place_at_most(double dt);
int place_at_least(double dt);

/// What to try next, from the trials so far in any order; nothing when the search is over.
/// It gallops from the start by three places, up while trials are sound or down while they are not, and halves what
/// lies between. Should soundness not be monotonic, the least unsound step counts.
std::optional<int> next_trial(const StepSearch& search, std::span<const StepTrial> trials);

/// The largest step below every unsound one that was found sound; nothing when there is none.
std::optional<int> largest_sound(std::span<const StepTrial> trials);

}  // namespace sessile
