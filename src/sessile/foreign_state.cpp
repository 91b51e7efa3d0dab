#include "sessile/foreign_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sessile/core/error.h"
#include "sessile/core/hash.h"

namespace sessile {
namespace {

// Counts of a run stay far below: a billion steps a second would take 146 years. What is added to them cannot overflow.
constexpr std::int64_t most_counted = std::int64_t{1} << 62;

bool is_count(std::int64_t value) { return value >= 0 && value <= most_counted; }

bool counts_are_sound(const SimulationState& state) {
  const Totals& t = state.totals;
  const std::int64_t all[] = {t.steps,
                              t.iterations,
                              t.divergence_iterations,
                              t.solves,
                              t.unconverged_solves,
                              t.overruled_steps,
                              t.emitted,
                              t.waits,
                              t.out,
                              t.lost,
                              state.next_id,
                              state.stage_times.clock_reads,
                              state.last_step.iterations,
                              state.last_step.divergence_iterations};
  return std::all_of(std::begin(all), std::end(all), is_count) &&
         std::all_of(state.sources.begin(), state.sources.end(),
                     [](const LayerProgress& source) { return is_count(source.emitted); });
}

/// Whether each particle has a number of its own below that of the next one.
bool ids_are_sound(const SimulationState& state) {
  std::vector<std::int64_t> ids(state.particles.id.begin(), state.particles.id.end());
  std::sort(ids.begin(), ids.end());
  return ids.empty() ||
         (ids.front() >= 0 && ids.back() < state.next_id && std::adjacent_find(ids.begin(), ids.end()) == ids.end());
}

}  // namespace

std::uint64_t digest(const Walls& walls) {
  std::uint64_t sum = 0;
  const auto add = [&](const auto& array) { sum = hash(array.data(), bytes_of(array), sum); };
  add(walls.position.x);
  add(walls.position.y);
  add(walls.position.z);
  add(walls.solid);
  return sum;
}

void refuse_foreign(const SimulationState& state, const Scene& scene, const Walls& walls) {
  std::vector<std::string> faults;
  const std::size_t n = state.particles.size();
  bool whole = true, finite = true;
  state.particles.for_each_field([&](const auto& array) {
    whole = whole && array.size() == n;
    finite = finite && std::all_of(array.begin(), array.end(), [](auto x) { return std::isfinite(x); });
  });
  if (!counts_are_sound(state)) {
    faults.emplace_back("the state counts below zero, or further than a run comes");
  } else if (static_cast<std::int64_t>(n) + state.totals.out != state.next_id || state.totals.emitted > state.next_id) {
    faults.push_back(fmt::format("the state's particles do not add up: {} of {} are there and {} have left", n,
                                 state.next_id, state.totals.out));
  }
  if (!whole) faults.emplace_back("the state's fields of particles are of different lengths");
  if (!finite) faults.emplace_back("the state has numbers that are not finite");
  if (!ids_are_sound(state)) faults.emplace_back("the state's particles do not have a number each");
  const auto& masses = state.particles.mass;
  if (std::any_of(masses.begin(), masses.end(), [](auto mass) { return !(mass > 0); })) {
    faults.emplace_back("the state has particles without a mass");
  }
  if (!(state.time >= 0) || !std::isfinite(state.time)) faults.emplace_back("the state has no time");
  if (!(state.last_step.dt >= 0) || !std::isfinite(state.last_step.dt)) {
    faults.emplace_back("the state's last step has no length");
  }
  if (state.sources.size() != scene.emitters.size()) {
    faults.push_back(
        fmt::format("the state has {} emitters, the scene {}", state.sources.size(), scene.emitters.size()));
  }
  if (state.forces.size() != walls.labels.size() || state.solids_digest != digest(walls)) {
    faults.emplace_back(
        "the solids are not those of the state: a mesh file has changed since, or the scene is another one");
  }
  if (const auto* method = std::get_if<Wcsph>(&scene.pressure); method != nullptr && !method->sound_speed) {
    faults.emplace_back("pressure.sound_speed: must be given, as it was settled when the run started");
  }
  if (!faults.empty()) throw SceneError(std::move(faults));
}

}  // namespace sessile
