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
  state.solves = totals.solves;
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
  if (state.pressure_work > greatest_work_) {
    greatest_work_ = state.pressure_work;
    time_of_greatest_work_ = state.time;
  }
  if (state.lost > 0) {
    judge(state.time, fmt::format("{} passed through a solid", state.lost == 1 ? "a particle has" : "particles have"));
  }
  constexpr std::int64_t enough = 50;  // the first steps have little energy, and few solves
  if (state.steps >= enough) judge_pressure_work(limits_.runaway);
  if (state.solves >= enough) judge_solves(limits_.hopeless);
}

void Soundness::fail(double time, const std::string& message) { judge(time, message); }

void Soundness::finish() {
  judge_pressure_work(limits_.pressure_work);
  if (density_error() > limits_.density_error) {
    judge(last_.time, fmt::format("the mean density error is {:.4g} %; the limit is {:g} %", 100 * density_error(),
                                  100 * limits_.density_error));
  }
  judge_solves(limits_.unconverged);
}

void Soundness::judge_pressure_work(double limit) {
  if (greatest_work_ <= limit * greatest_energy_) return;
  judge(
      time_of_greatest_work_,
      fmt::format("pressure has put {:.3g} J into the liquid, {:.3g} % of the greatest kinetic energy ({:.3g} J); the "
                  "limit is {:g} %",
                  greatest_work_, 100 * pressure_work_share(), greatest_energy_, 100 * limit));
}

void Soundness::judge_solves(double limit) {
  if (unconverged_share() <= limit) return;
  judge(last_.time, fmt::format("{} of {} pressure solves ended above their error, {:.3g} %; the limit is {:g} %",
                                last_.unconverged_solves, last_.solves, 100 * unconverged_share(), 100 * limit));
}

double Soundness::pressure_work_share() const { return greatest_energy_ > 0 ? greatest_work_ / greatest_energy_ : 0; }

double Soundness::density_error() const {
  return error_sum_ / static_cast<double>(std::max<std::int64_t>(1, last_.steps));
}

double Soundness::unconverged_share() const { return share(last_.unconverged_solves, last_.solves); }

void Soundness::judge(double time, std::string reason) {
  if (!verdict_.sound) return;  // the first reason stays
  verdict_ = {false, time, std::move(reason)};
}

}  // namespace sessile
