#include "sessile/measure/step_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace sessile {
namespace {

constexpr std::array<std::string_view, 10> series{"1", "1.25", "1.6", "2", "2.5", "3.15", "4", "5", "6.3", "8"};
constexpr int per_decade = static_cast<int>(series.size());
constexpr int gallop = 3;

/// The least unsound place.
std::optional<int> least_unsound(std::span<const StepTrial> trials) {
  std::optional<int> least;
  for (const StepTrial& trial : trials) {
    if (!trial.sound && (!least || trial.place < *least)) least = trial.place;
  }
  return least;
}

}  // namespace

double step_at(int place) {
  const int decade = place >= 0 ? place / per_decade : -((per_decade - 1 - place) / per_decade);
  const std::string text = fmt::format("{}e{}", series[static_cast<std::size_t>(place - per_decade * decade)], decade);
  double step = 0;
  std::from_chars(text.data(), text.data() + text.size(), step);
  return step;
}

int place_at_most(double dt) {
  int place = static_cast<int>(std::ceil(per_decade * std::log10(dt))) + 1;
  while (step_at(place) > dt) --place;
  return place;
}

int place_at_least(double dt) {
  const int place = place_at_most(dt);
  return step_at(place) == dt ? place : place + 1;
}

std::optional<int> next_trial(const StepSearch& search, std::span<const StepTrial> trials) {
  if (search.most < search.least) return {};
  if (trials.empty()) return std::clamp(search.start, search.least, search.most);
  const std::optional<int> unsound = least_unsound(trials), sound = largest_sound(trials);
  if (!unsound) return *sound < search.most ? std::optional(std::min(*sound + gallop, search.most)) : std::nullopt;
  if (!sound) return *unsound > search.least ? std::optional(std::max(*unsound - gallop, search.least)) : std::nullopt;
  if (*unsound - *sound > 1) return *sound + (*unsound - *sound) / 2;
  return {};
}

std::optional<int> largest_sound(std::span<const StepTrial> trials) {
  const int limit = least_unsound(trials).value_or(std::numeric_limits<int>::max());
  std::optional<int> largest;
  for (const StepTrial& trial : trials) {
    if (trial.sound && trial.place < limit && (!largest || trial.place > *largest)) largest = trial.place;
  }
  return largest;
}

}  // namespace sessile
