#include "sessile/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sessile/core/error.h"
#include "sessile/core/parallel.h"
#include "sessile/forces/viscosity.h"
#include "sessile/neighbors/step_view.h"
#include "sessile/particles/density.h"
#include "sessile/pressure/pressure_force.h"
#include "sessile/stage_watch.h"
#include "sessile/time/time_step.h"

namespace sessile {
namespace {

double greatest_length(const Array3& a) {
  return std::sqrt(
      maximum(a.size(), [&](int i) { return static_cast<double>(squared_length(a[static_cast<std::size_t>(i)])); }));
}

}  // namespace

// Algorithm 1 of the paper. Its first lines, neighbours, densities and normals of x(t), closed the step before (and the
// constructor), so that whoever looks between two steps sees them up to date.
void Simulation::step() {
  accelerate();                        // all forces but pressure
  const double dt = next_time_step();  // the largest that every bound allows
  predict_velocities(dt);              // v* = v + dt a
  solve_pressure(dt);                  // until rho(t + dt) <= rho0 on average
  move(dt);                            // v = v* + dt a^p,  x = x + dt v
  time_ += dt;
  take_out_what_left();
  let_in_new_layers();
  count();
  look_around();                      // neighbours, densities, normals of x(t + dt)
  free_velocities_of_divergence(dt);  // for solvers that start from such velocities (DFSPH)
  ++totals_.steps;
}

void Simulation::look_around() {
  {
    const StageWatch watch(stage_times_, &StageTimes::neighbors);
    const auto h = static_cast<Real>(units_.support_radius);
    grid_.build(particles_.position, grid_shape_);
    particles_.reorder(grid_.order());
    const SortedPoints fluid{particles_.position, grid_}, samples{walls_.position, wall_grid_};
    fluid_neighbors_.build(fluid, fluid, space_, h);
    wall_neighbors_.build(fluid, samples, space_, h);
  }
  const StageWatch watch(stage_times_, &StageTimes::density);
  for (auto* pairs : {&position_pairs_, &pairs_}) pairs->resize(2 * particles_.size());
  pair_up(sessile::view(particles_.position), particles_.size(), position_pairs_.data());
  const auto& masses = particles_.mass;
  equal_masses_ =
      sum(masses.size(), [&](int i) { return masses[static_cast<std::size_t>(i)] == masses[0] ? 0.0 : 1.0; }) == 0;
  compute_density(view(), density_);
  find_normals();
}

void Simulation::find_normals() {
  const bool wanted = std::any_of(scene_.forces.begin(), scene_.forces.end(), [](const Force& force) {
    return std::visit([](const auto& model) { return model.uses_normals; }, force);
  });
  const auto& columns = scene_.output.columns;
  if (wanted || std::find(columns.begin(), columns.end(), "normal") != columns.end()) {
    compute_normals(view(), normal_);
  } else {
    normal_.assign(particles_.size(), {});
  }
}

void Simulation::accelerate() {
  const StageWatch watch(stage_times_, &StageTimes::forces);
  const StepView s = view();
  walls_.forces.assign(walls_.forces.size(), {});
  acceleration_.resize(s.n);
  const auto gravity = vec_cast<Real>(scene_.gravity);
  for_each(s.n, [&](int i) { acceleration_.set(static_cast<std::size_t>(i), gravity); });
  add_viscosity(s, scene_.fluid.viscosity, acceleration_);
  add_viscosity_reaction(s, walls_, walls_.forces);
  for (const Force& force : scene_.forces) {
    std::visit(
        [&](const auto& model) {
          model.add_acceleration(s, acceleration_);
          model.add_reaction(s, walls_, walls_.forces);
        },
        force);
  }
}

double Simulation::next_time_step() {
  const StageWatch watch(stage_times_, &StageTimes::time_step);
  MotionScale scale;
  scale.spacing = units_.spacing;
  scale.rest_density = units_.rest_density;
  scale.sound_speed = sound_speed(scene_.pressure);
  scale.speed = greatest_length(particles_.velocity);
  scale.acceleration = greatest_length(acceleration_);
  scale.viscosity = scene_.fluid.viscosity;
  for (const Real nu : walls_.viscosity) {
    scale.viscosity = std::max(scale.viscosity, static_cast<double>(nu) * units_.rest_density);
  }
  scale.tension = tension();
  scale.solver_effort = effort(scene_.pressure, last_step_.iterations);
  const TimeStep chosen = choose_time_step(scene_.time, scale, last_step_.dt);
  last_step_.dt = chosen.dt;
  last_step_.bound = chosen.bound;
  last_step_.overruled = chosen.overruled;
  totals_.overruled_steps += !chosen.overruled.empty();
  return chosen.dt;
}

void Simulation::predict_velocities(double dt) {
  const StageWatch watch(stage_times_, &StageTimes::integration);
  const auto step = static_cast<Real>(dt);
  for_each(particles_.size(), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    particles_.velocity.set(k, particles_.velocity[k] + step * acceleration_[k]);
  });
}

void Simulation::solve_pressure(double dt) {
  const StageWatch watch(stage_times_, &StageTimes::pressure);
  pressure_.mean.swap(particles_.mean_pressure);  // in the solver's hands for the solve
  const PressureResult result = solve(scene_.pressure, view(), particles_.velocity, dt, particles_.pressure, pressure_);
  pressure_.mean.swap(particles_.mean_pressure);
  add_pressure_reaction(view(), pressure_.stress, walls_, walls_.forces);
  last_step_.iterations = result.iterations;
  last_step_.converged = result.converged;
  last_step_.predicted_error = result.error;
  last_step_.predicted_error_max = result.error_max;
  totals_.iterations += result.iterations;
  totals_.solves += 1;
  totals_.unconverged_solves += !result.converged;
}

void Simulation::free_velocities_of_divergence(double dt) {
  if (!frees_velocities_of_divergence(scene_.pressure)) return;
  const StageWatch watch(stage_times_, &StageTimes::pressure);
  const auto energy = [&] {
    return units_.particle_mass() *
           sum(particles_.size(), [&](int i) { return kinetic(particles_, static_cast<std::size_t>(i)); });
  };
  const double before = energy();
  const PressureResult result =
      remove_divergence(scene_.pressure, view(), particles_.velocity, dt, particles_.divergence_pressure, pressure_);
  add_pressure_reaction(view(), pressure_.stress, walls_, walls_.forces);
  last_step_.kinetic_energy = energy();
  totals_.energy.pressure += last_step_.kinetic_energy - before;
  last_step_.divergence_iterations = result.iterations;
  last_step_.converged = last_step_.converged && result.converged;
  totals_.divergence_iterations += result.iterations;
  totals_.unconverged_solves += !result.converged;
  totals_.solves += 1;
  if (!std::isfinite(last_step_.kinetic_energy)) {
    throw RunError(fmt::format("velocities are no longer finite after the divergence solve at {:g} s", time_));
  }
}

void Simulation::let_in_new_layers() {
  const StageWatch watch(stage_times_, &StageTimes::integration);
  double energy = 0;
  for (LayerSource& source : sources_) {
    const std::size_t before = particles_.size();
    const Emission emission = source.emit(time_, particles_, next_id_);
    for (std::size_t k = before; k < particles_.size(); ++k) energy += kinetic(particles_, k);
    totals_.emitted += static_cast<std::int64_t>(particles_.size() - before);
    totals_.waits += emission == Emission::began_to_wait;
  }
  totals_.energy.emitted += units_.particle_mass() * energy;
  last_step_.kinetic_energy += units_.particle_mass() * energy;
}

bool Simulation::finished() const { return time_ >= scene_.time.end - 1e-6 * last_step_.dt; }

StepView Simulation::view() const {
  StepView s(units_, space_, particles_, walls_, fluid_neighbors_, wall_neighbors_);
  s.rho = sessile::view(density_);
  s.normal = sessile::view(normal_);
  s.m.all_same = equal_masses_;
  s.x.xy = position_pairs_.data();
  s.pairs = pairs_.data();
  return s;
}

}  // namespace sessile
