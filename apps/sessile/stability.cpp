#include "stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "advice.h"
#include "fault_dump.h"
#include "sessile/core/error.h"

namespace sessile::app {
namespace {

// Steps that failed, for which steps stay short after the fault, unless the scene says how long.
constexpr double held_steps = 100;

StabilitySettings settings_of(const Scene& scene, bool watched) {
  StabilitySettings settings = scene.stability;
  if (!watched) settings.speed = settings.density = settings.escapes = settings.passages = false;
  return settings;
}

double keep_interval(const Scene& scene) { return scene.stability.keep_interval.value_or(scene.output.frame_interval); }

/// The scene with no step longer than `dt`.
Scene limited(Scene scene, double dt) {
  TimeSettings& time = scene.time;
  if (time.fixed_dt) time.fixed_dt = std::min(*time.fixed_dt, dt);
  time.dt_max = std::min(time.dt_max, dt);
  time.dt_min = std::min(time.dt_min, dt);
  return scene;
}

std::string in_vain(const StabilityState& state) {
  if (state.retries == 0) return "";
  return fmt::format("The run had gone back {} in a row, at last to steps of at most {:g} s, in vain. ",
                     state.retries == 1 ? "once" : fmt::format("{} times", state.retries), state.dt_limit);
}

}  // namespace

Stability::Stability(const Scene& scene, bool watched, const std::optional<SessionState>& before)
    : scene_(scene),
      settings_(settings_of(scene, watched)),
      watched_(watched),
      health_(settings_, before ? before->stability.health : HealthState{}),
      state_(before ? before->stability : StabilityState{}),
      keep_schedule_(keep_interval(scene)) {}

bool Stability::due(const Simulation& simulation) const {
  return watched_ && !health_.doubtful() && keep_schedule_.due(simulation.time());
}

void Stability::keep(const Simulation& simulation, SessionState records) {
  keep_schedule_.done(simulation.time());
  state_.health = health_.state();
  records.stability = state_;
  const std::size_t most = goes_back() ? 2 : 1;
  if (kept_.size() == most) kept_.erase(kept_.begin());
  kept_.push_back({simulation.state(), std::move(records)});
}

bool Stability::step(Simulation& simulation, Progress& progress) {
  set_pace(simulation);
  std::vector<RunFault> found;
  try {
    simulation.step();
    found = health_.look(simulation);
  } catch (const RunError&) {
    if (simulation.health().not_finite.count == 0) throw;  // of another kind, which says itself what helps
    found = health_.look(simulation);
  }
  state_.health = health_.state();
  for (const RunFault& fault : found) {
    if (!fault.counts) {
      tell(fault, progress);
    } else if (goes_back() && state_.retries < settings_.retries) {
      go_back(simulation, fault, progress);
      return false;
    } else {
      end(simulation, fault);
    }
  }
  return true;
}

/// Takes the limit on the step, and takes it off again when its time has come.
void Stability::set_pace(Simulation& simulation) {
  if (state_.dt_limit > 0 && simulation.time() >= state_.until) {
    state_.dt_limit = 0;
    state_.retries = 0;
  }
  if (state_.dt_limit == pace_) return;
  pace_ = state_.dt_limit;
  simulation.retune(pace_ > 0 ? limited(scene_, pace_) : scene_);
}

/// Says once for each kind what happened first; the columns count the rest.
void Stability::tell(const RunFault& fault, Progress& progress) {
  if (!watched_ || std::find(told_.begin(), told_.end(), fault.kind) != told_.end()) return;
  told_.push_back(fault.kind);
  progress.warn(fault.message);
}

void Stability::go_back(Simulation& simulation, const RunFault& fault, Progress& progress) {
  kept_.resize(1);
  Kept& good = kept_.front();
  const double failed = state_.dt_limit > 0 ? std::min(state_.dt_limit, fault.dt) : fault.dt;
  state_.health = good.records.stability.health;
  state_.dt_limit = settings_.dt_factor * failed;
  // For no less than what is undone: where every full step fails again, a run would else recompute the same for ever.
  const double undone = std::max(2 * keep_interval(scene_), fault.time - good.state.time);
  const double hold = std::max(settings_.hold.value_or(held_steps * fault.dt), undone);
  state_.until = std::max(state_.until, fault.time + hold);
  ++state_.retries;
  ++state_.went_back;
  state_.undone_steps += fault.step - good.state.totals.steps;
  state_.last_fault = fault.message;
  good.records.stability = state_;
  health_ = Health(settings_, state_.health);
  pace_ = 0;
  simulation.retune(scene_);
  simulation.go_back_to(good.state);
  keep_schedule_.done(good.state.time);
  progress.warn(fmt::format("{}. The run goes back to {:g} s and on in steps of at most {:g} s ({} of {})",
                            fault.message, good.state.time, state_.dt_limit, state_.retries, settings_.retries));
}

void Stability::end(const Simulation& simulation, const RunFault& fault) {
  fault_ = fault;
  if (!watched_) throw RunError(fault.message);
  faulty_ = faulty_frame(simulation, fault);
  throw RunError(fmt::format("{}. {}{}", fault.message, in_vain(state_), advice(fault, settings_)));
}

StabilityFacts Stability::facts() const { return {state_.went_back, state_.undone_steps, state_.last_fault, fault_}; }

std::string Stability::dump(const std::filesystem::path& results, Simulation& simulation) const {
  if (!watched_ || !fault_ || kept_.empty()) return "";
  const auto folder = results / fault_folder_name;
  try {
    simulation.retune(scene_);
    simulation.go_back_to(good().state);
    write_fault_dump(folder, simulation, faulty_, *fault_, advice(*fault_, settings_));
  } catch (const std::exception& e) {
    const std::string help = advice(e);
    return fmt::format("The state of the fault could not be kept: {}{}{}", sentence(e), help.empty() ? "" : "; ", help);
  }
  return fmt::format(
      "{} holds the last good state, of {:g} s, and the faulty one: `sessile view {}` shows them, and "
      "`sessile run --resume {} --set {}` goes on from the good one",
      folder.string(), good().state.time, folder.string(), folder.string(), way_on(*fault_));
}

}  // namespace sessile::app
