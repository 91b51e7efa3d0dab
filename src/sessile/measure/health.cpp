#include "sessile/measure/health.h"

#include <fmt/format.h>

#include <algorithm>

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
  f.time = simulation.time();
  f.step = simulation.totals().steps;
  f.dt = last.dt;
  f.bound = last.bound;
  f.overruled = last.overruled;
  f.count = event.count;
  f.particle = event.id;
  f.position = event.position;
  f.velocity = event.velocity;
  return f;
}

RunFault not_finite(const Simulation& simulation) {
  RunFault f = begun(simulation, RunFaultKind::not_finite, simulation.health().not_finite);
  ++f.step;  // which did not come to its end
  f.time += f.dt;
  f.message = fmt::format(
                  "{} of {} particles have no finite position or pressure after {}; the first, particle {}, "
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

RunFault density(const Simulation& simulation, int steps) {
  const auto& density = simulation.density();
  const auto densest = static_cast<std::size_t>(std::max_element(density.begin(), density.end()) - density.begin());
  const Particles& p = simulation.particles();
  RunFault f = begun(simulation, RunFaultKind::density,
                     {1, p.id[densest], vec_cast<double>(p.position[densest]), vec_cast<double>(p.velocity[densest])});
  f.count = std::count_if(density.begin(), density.end(), [](Real rho) { return rho > 1; });
  f.message = fmt::format(
      "the liquid stays compressed, by {:.3g} % on average, and {} pressure solves in a row ended above their error "
      "without getting better, up to {}; most of all particle {}, by {:.3g} %, at {}",
      100 * compression(density).average, steps, step_text(f), f.particle,
      100 * (static_cast<double>(density[densest]) - 1), whereabouts(f));
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
  if (fault.kind == RunFaultKind::density) text += ", or more pressure.max_iterations";
  if (settings.on_fault == OnFault::stop) text += "; stability.on_fault = \"go_back\" tries shorter steps by itself";
  return text;
}

}  // namespace sessile
