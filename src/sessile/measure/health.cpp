#include "sessile/measure/health.h"

#include <fmt/format.h>

#include <algorithm>

#include "sessile/core/parallel.h"
#include "sessile/measure/diagnostics.h"
#include "sessile/simulation.h"

namespace sessile {
namespace {

/// How many density_limits of compression a solve's own word weighs less than.
constexpr double beyond_a_solves_word = 5;

std::string place(const Vec3d& x) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", x.x, x.y, x.z); }

/// `(0.1, 0, 2) m with (0, 0, -3) m/s`
std::string whereabouts(const RunFault& f) {
  return fmt::format("{} m with {} m/s", place(f.position), place(f.velocity));
}

/// `step 12 of 0.02 s (fixed, above the cfl bound), to 0.24 s`
std::string step_text(const RunFault& f) {
  const std::string above = f.overruled.empty() ? "" : fmt::format(", above the {} bound", f.overruled);
  return fmt::format("step {} of {:g} s ({}{}), to {:g} s", f.step, f.dt, f.bound, above, f.time);
}

/// The change that lets a run go on where a particle is through a solid, or "": that spoils little else.
std::string warning_only(const RunFault& fault) {
  if (fault.kind == RunFaultKind::escape) return "stability.escapes=false";
  if (fault.kind == RunFaultKind::passage) return "stability.passages=false";
  return "";
}

std::string others(const RunFault& f) {
  if (f.count <= 1) return "";
  return fmt::format(", and {} more with it", f.count - 1);
}

RunFault begun(const Simulation& simulation, RunFaultKind kind, const ParticleEvent& event) {
  const StepReport& last = simulation.last_step();
  RunFault f;
  f.kind = kind;
  f.time = simulation.health().time;
  f.step = simulation.health().step;
  f.dt = last.dt;
  f.bound = last.bound;
  f.overruled = last.overruled;
  f.count = event.count;
  f.particle = event.id;
  f.position = event.position;
  f.velocity = event.velocity;
  return f;
}

std::size_t densest(const Array<Real>& density) {
  return static_cast<std::size_t>(std::max_element(density.begin(), density.end()) - density.begin());
}

RunFault not_finite(const Simulation& simulation) {
  RunFault f = begun(simulation, RunFaultKind::not_finite, simulation.health().not_finite);
  f.message = fmt::format(
                  "{} of {} particles have no finite position, velocity or pressure after {}; the first, particle {}, "
                  "stood at {}",
                  f.count, simulation.particles().size(), step_text(f), f.particle, place(f.position)) +
              " m";
  return f;
}

RunFault speed(const Simulation& simulation) {
  RunFault f = begun(simulation, RunFaultKind::speed, simulation.health().thrown);
  const double length = simulation.health().throw_length;
  f.message = fmt::format("particle {} was thrown {:.3g} m off its way, {:.3g} support radii, in {}; it is at {}",
                          f.particle, length, length / simulation.units().support_radius, step_text(f), whereabouts(f));
  return f;
}

/// The particle that went farther in the step than anything acts on it, where dt_min made the step longer than its
/// bounds ask for: none of them has held what it did. -1 where there is none.
int farthest_beyond(const Simulation& simulation, double limit) {
  const StepReport& last = simulation.last_step();
  if (last.bound != "dt_min") return -1;
  const auto& velocity = simulation.particles().velocity;
  int farthest = -1;
  double most = limit * simulation.units().support_radius / last.dt;
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    const double v = length(vec_cast<double>(velocity[k]));
    if (!(v > most)) continue;
    most = v;
    farthest = static_cast<int>(k);
  }
  return farthest;
}

RunFault too_fast(const Simulation& simulation, int place) {
  const Particles& p = simulation.particles();
  const auto k = static_cast<std::size_t>(place);
  RunFault f = begun(simulation, RunFaultKind::speed,
                     {1, p.id[k], vec_cast<double>(p.position[k]), vec_cast<double>(p.velocity[k])});
  const double way = length(f.velocity) * f.dt;
  f.message = fmt::format("particle {} went {:.3g} m, {:.3g} support radii, in {}; it is at {}", f.particle, way,
                          way / simulation.units().support_radius, step_text(f), whereabouts(f));
  return f;
}

/// Names the densest particle, and counts those above `limit` rest densities.
RunFault of_the_densest(const Simulation& simulation, RunFaultKind kind, Real limit) {
  const auto& density = simulation.density();
  const Particles& p = simulation.particles();
  const std::size_t k = densest(density);
  RunFault f = begun(simulation, kind, {1, p.id[k], vec_cast<double>(p.position[k]), vec_cast<double>(p.velocity[k])});
  f.count = std::count_if(density.begin(), density.end(), [&](Real rho) { return rho > limit; });
  return f;
}

RunFault collapse(const Simulation& simulation, double limit) {
  const auto& density = simulation.density();
  RunFault f = of_the_densest(simulation, RunFaultKind::collapse, static_cast<Real>(limit));
  f.message =
      fmt::format("the liquid has collapsed: particle {} has {:.3g} times the rest density after {}{}; it is at {}",
                  f.particle, density[densest(density)], step_text(f), others(f), whereabouts(f));
  return f;
}

RunFault density(const Simulation& simulation, int steps) {
  const auto& density = simulation.density();
  RunFault f = of_the_densest(simulation, RunFaultKind::density, 1);
  const char* const solves = simulation.last_step().converged ? "that say they reached their error went by"
                                                              : "in a row ended above their error";
  f.message = fmt::format(
      "the liquid stays compressed, by {:.3g} % on average, and {} pressure solves {} without getting better, up to "
      "{}; "
      "most of all particle {}, by {:.3g} %, at {}",
      100 * compression(density).average, steps, solves, step_text(f), f.particle,
      100 * (static_cast<double>(density[densest(density)]) - 1), whereabouts(f));
  return f;
}

RunFault passage(const Simulation& simulation, RunFaultKind kind, const ParticleEvent& event, int solid,
                 std::string_view what) {
  RunFault f = begun(simulation, kind, event);
  f.message =
      fmt::format("particle {} {} \"{}\" in {}{}; it is at {}", f.particle, what,
                  simulation.walls().labels[static_cast<std::size_t>(solid)], step_text(f), others(f), whereabouts(f));
  return f;
}

}  // namespace

std::vector<RunFault> Health::look(const Simulation& simulation) {
  const StepHealth& last = simulation.health();
  std::vector<RunFault> found;
  if (last.not_finite.count > 0) return {not_finite(simulation)};
  const auto density_of = [&](int i) { return static_cast<double>(simulation.density()[static_cast<std::size_t>(i)]); };
  if (maximum(simulation.density().size(), density_of) > settings_.collapse_limit) {
    found.push_back(collapse(simulation, settings_.collapse_limit));
  }
  if (settings_.speed && last.throw_length > settings_.speed_limit * simulation.units().support_radius) {
    found.push_back(speed(simulation));
  } else if (settings_.speed) {
    const int farthest = farthest_beyond(simulation, settings_.speed_limit);
    if (farthest >= 0) found.push_back(too_fast(simulation, farthest));
  }
  if (settings_.density && stays_compressed(simulation)) {
    found.push_back(density(simulation, settings_.density_steps));
  }
  if (last.escape.count > 0) {
    found.push_back(
        passage(simulation, RunFaultKind::escape, last.escape, last.escaped, "left what holds the liquid,"));
    found.back().counts = settings_.escapes;
  }
  if (last.passage.count > 0) {
    found.push_back(passage(simulation, RunFaultKind::passage, last.passage, last.passed, "passed through the solid"));
    found.back().counts = settings_.passages;
  }
  return found;
}

/// Judges stretches of density_steps steps, one after the other. A step whose liquid is compressed less than counts
/// ends a stretch.
bool Health::stays_compressed(const Simulation& simulation) {
  const bool promised = promises_density(simulation.scene().pressure);
  const double error = promised ? compression(simulation.density()).average : 0;
  const double limit = settings_.density_limit * (simulation.last_step().converged ? beyond_a_solves_word : 1);
  if (!(error > limit)) {
    state_ = {};
    return false;
  }
  ++state_.compressed_steps;
  const std::int64_t half = settings_.density_steps / 2;
  if (state_.compressed_steps <= half) state_.first_half += error;
  if (state_.compressed_steps > settings_.density_steps - half) state_.second_half += error;
  if (state_.compressed_steps < settings_.density_steps) return false;
  const bool falls = state_.second_half < state_.first_half;
  state_ = {};
  return !falls;
}

std::string advice(const RunFault& fault, const StabilitySettings& settings) {
  std::string text = "A smaller time.dt_max or time.cfl may carry it over this";
  if (fault.bound == "fixed") {
    text = "A smaller time.fixed_dt may carry it over this, or leave it out for steps that follow the motion";
  } else if (fault.bound == "dt_min") {
    text = "A smaller time.dt_min may carry it over this: the other bounds ask for shorter steps than it allows";
  }
  if (fault.kind == RunFaultKind::collapse) text += ", or less tension, or with wcsph a greater pressure.sound_speed";
  if (fault.kind == RunFaultKind::density) text += ", or more pressure.max_iterations";
  if (const std::string warned = warning_only(fault); !warned.empty()) {
    text += fmt::format("; with `--set {}` it is a warning and a count", warned);
  }
  if (settings.on_fault == OnFault::stop) text += "; stability.on_fault = \"go_back\" tries shorter steps by itself";
  return text;
}

std::string way_on(const RunFault& fault) {
  if (std::string warned = warning_only(fault); !warned.empty()) return warned;
  const std::string_view key = fault.bound == "fixed" ? "fixed_dt" : fault.bound == "dt_min" ? "dt_min" : "dt_max";
  return fmt::format("time.{}={:.3g}", key, fault.dt / 2);
}

}  // namespace sessile
