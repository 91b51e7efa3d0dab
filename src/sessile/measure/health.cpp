#include "sessile/measure/health.h"

#include <fmt/format.h>

#include <algorithm>

#include "sessile/core/parallel.h"
#include "sessile/measure/diagnostics.h"
#include "sessile/simulation.h"

namespace sessile {
namespace {

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
  f.message = fmt::format(
      "the liquid stays compressed, by {:.3g} % on average, and {} pressure solves in a row ended above their error "
      "without getting better, up to {}; most of all particle {}, by {:.3g} %, at {}",
      100 * compression(density).average, steps, step_text(f), f.particle,
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

/// Judges stretches of density_steps steps, one after the other. A step whose solve reached its error, or whose liquid
/// is compressed less, ends a stretch.
bool Health::stays_compressed(const Simulation& simulation) {
  const double error = simulation.last_step().converged ? 0 : compression(simulation.density()).average;
  if (!(error > settings_.density_limit)) {
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
  std::string text = fault.bound == "fixed"
                         ? "A smaller time.fixed_dt may carry it over this, or leave it out for steps "
                           "that follow the motion"
                         : "A smaller time.dt_max or time.cfl may carry it over this";
  if (fault.kind == RunFaultKind::collapse) text += ", or less tension, or with wcsph a greater pressure.sound_speed";
  if (fault.kind == RunFaultKind::density) text += ", or more pressure.max_iterations";
  if (settings.on_fault == OnFault::stop) text += "; stability.on_fault = \"go_back\" tries shorter steps by itself";
  return text;
}

}  // namespace sessile
