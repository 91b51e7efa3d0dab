#include "sessile/measure/soundness.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sessile/measure/diagnostics.h"
#include "sessile/simulation.h"

namespace sessile {
namespace {

double share(std::int64_t part, std::int64_t whole) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::int64_t>(1, whole));
}

}  // namespace

void Soundness::look(const Simulation& simulation) {
  const Totals& totals = simulation.totals();
  SoundnessState state;
  state.time = simulation.time();
  state.density_error = compression(simulation.density()).average;
  state.steps = totals.steps;
  state.unconverged_solves = totals.unconverged_solves;
  state.lost = totals.lost;
  state.kinetic_energy = simulation.last_step().kinetic_energy;
  state.pressure_work = totals.energy.pressure;
  look(state);
}

void Soundness::look(const SoundnessState& state) {
  last_ = state;
  error_sum_ += state.density_error;
  greatest_error_ = std::max(greatest_error_, state.density_error);
  greatest_energy_ = std::max(greatest_energy_, state.kinetic_energy);
  if (greatest_energy_ > 0) greatest_share_ = std::max(greatest_share_, state.pressure_work / greatest_energy_);
  if (state.lost > 0) {
    judge(state.time, fmt::format("{} passed through a solid", state.lost == 1 ? "a particle has" : "particles have"));
  }
  if (state.pressure_work > limits_.pressure_work * greatest_energy_) {
    judge(state.time,
          fmt::format("pressure has put {:.3g} J into the liquid, {:.3g} % of the greatest kinetic energy so far "
                      "({:.3g} J); the limit is {:g} %",
                      state.pressure_work, 100 * state.pressure_work / greatest_energy_, greatest_energy_,
                      100 * limits_.pressure_work));
  }
}

void Soundness::fail(double time, const std::string& message) { judge(time, message); }

void Soundness::finish() {
  if (density_error() > limits_.density_error) {
    judge(last_.time, fmt::format("the mean density error is {:.4g} %; the limit is {:g} %", 100 * density_error(),
                                  100 * limits_.density_error));
  }
  if (unconverged_share() > limits_.unconverged) {
    judge(last_.time,
          fmt::format("{} of {} pressure solves ended above their error, {:.3g} %; the limit is {:g} %",
                      last_.unconverged_solves, last_.steps, 100 * unconverged_share(), 100 * limits_.unconverged));
  }
}

double Soundness::density_error() const {
  return error_sum_ / static_cast<double>(std::max<std::int64_t>(1, last_.steps));
}

double Soundness::unconverged_share() const { return share(last_.unconverged_solves, last_.steps); }

void Soundness::judge(double time, std::string reason) {
  if (!verdict_.sound) return;  // the first reason stays
  verdict_ = {false, time, std::move(reason)};
}

}  // namespace sessile
