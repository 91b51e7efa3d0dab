#include "sessile/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sessile/core/error.h"
#include "sessile/core/parallel.h"
#include "sessile/forces/viscosity.h"
#include "sessile/neighbors/step_view.h"
#include "sessile/particles/density.h"
#include "sessile/pressure/pressure_force.h"
#include "sessile/time/time_step.h"

namespace sessile {
namespace {

/// Adds the wall time of its own life to a stage.
class Stopwatch {
 public:
  Stopwatch(StageTimes& times, double StageTimes::*stage) : times_(times), stage_(stage) {}
  ~Stopwatch() {
    times_.*stage_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    times_.clock_reads += 2;
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  StageTimes& times_;
  double StageTimes::*stage_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Kinetic energy in units of a particle mass of rho0 dx^3 [m^2/s^2].
double kinetic(const Particles& particles, std::size_t k) {
  return 0.5 * static_cast<double>(particles.mass[k]) * squared_length(vec_cast<double>(particles.velocity[k]));
}

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
  look_around();                      // neighbours, densities, normals of x(t + dt)
  free_velocities_of_divergence(dt);  // for solvers that start from such velocities (DFSPH)
  ++totals_.steps;
}

void Simulation::look_around() {
  {
    const Stopwatch watch(stage_times_, &StageTimes::neighbors);
    const auto h = static_cast<Real>(units_.support_radius);
    grid_.build(particles_.position, grid_shape_);
    particles_.reorder(grid_.order());
    const SortedPoints fluid{particles_.position, grid_}, samples{walls_.position, wall_grid_};
    fluid_neighbors_.build(fluid, fluid, space_, h);
    wall_neighbors_.build(fluid, samples, space_, h);
  }
  const Stopwatch watch(stage_times_, &StageTimes::density);
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
  const Stopwatch watch(stage_times_, &StageTimes::forces);
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
  const Stopwatch watch(stage_times_, &StageTimes::time_step);
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
  const Stopwatch watch(stage_times_, &StageTimes::integration);
  const auto step = static_cast<Real>(dt);
  for_each(particles_.size(), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    particles_.velocity.set(k, particles_.velocity[k] + step * acceleration_[k]);
  });
}

void Simulation::solve_pressure(double dt) {
  const Stopwatch watch(stage_times_, &StageTimes::pressure);
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
  const Stopwatch watch(stage_times_, &StageTimes::pressure);
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

void Simulation::move(double dt) {
  const Stopwatch watch(stage_times_, &StageTimes::integration);
  const auto step = static_cast<Real>(dt);
  // A particle without a wall sample in reach, and not faster than dx a step, cannot have met a solid whose samples lie
  // at most dx apart.
  const double far = units_.spacing * units_.spacing;
  const auto passed_a_solid = [&](std::size_t k, const Vec3d& from, const Vec3d& to) {
    if (wall_neighbors_.count(k) == 0 && squared_length(to - from) < far && !coarse_walls_) return false;
    return std::any_of(solids_.begin(), solids_.end(), [&](const auto& solid) { return solid.crossed(from, to); });
  };
  struct Events {
    std::int64_t passages = 0, not_finite = 0;
    double forces = 0, pressure = 0, kinetic = 0;  // work, and energy after the step [m^2/s^2]
  };
  const Events events = reduce(
      particles_.size(), Events{},
      [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        const Vec3r predicted = particles_.velocity[k];
        const Vec3r v = predicted + step * pressure_.acceleration[k];
        const Vec3r from = particles_.position[k], to = from + step * v;
        particles_.velocity.set(k, v);
        particles_.position.set(k, to);
        if (!std::isfinite(to.x) || !std::isfinite(to.y) || !std::isfinite(to.z)) return Events{0, 1};
        const Vec3d by_forces = dt * vec_cast<double>(acceleration_[k]);
        const Vec3d by_pressure = vec_cast<double>(v) - vec_cast<double>(predicted);
        const Vec3d mean = vec_cast<double>(v) - 0.5 * (by_forces + by_pressure);  // of the velocities around the step
        const auto m = static_cast<double>(particles_.mass[k]);
        return Events{passed_a_solid(k, vec_cast<double>(from), vec_cast<double>(to)) ? 1 : 0, 0,
                      m * dot(by_forces, mean), m * dot(by_pressure, mean), kinetic(particles_, k)};
      },
      [](const Events& a, const Events& b) {
        return Events{a.passages + b.passages, a.not_finite + b.not_finite, a.forces + b.forces,
                      a.pressure + b.pressure, a.kinetic + b.kinetic};
      });
  totals_.lost += events.passages + events.not_finite;
  totals_.energy.forces += units_.particle_mass() * events.forces;
  totals_.energy.pressure += units_.particle_mass() * events.pressure;
  last_step_.kinetic_energy = units_.particle_mass() * events.kinetic;
  if (events.not_finite > 0) {
    throw RunError(
        fmt::format("{} of {} particles have no finite position after the step of {:g} s at {:g} s: the step "
                    "is too long for these forces",
                    events.not_finite, particles_.size(), dt, time_));
  }
}

void Simulation::take_out_what_left() {
  if (!scene_.domain) return;
  const Stopwatch watch(stage_times_, &StageTimes::integration);
  const Domain& box = *scene_.domain;
  const Vec3r low = vec_cast<Real>(box.min), high = vec_cast<Real>(box.max);
  const auto into_period = [](Edge edge, Real& x, Real start, Real end) {
    if (edge != Edge::periodic || (x >= start && x < end)) return;
    x -= (end - start) * std::floor((x - start) / (end - start));
    if (x < start || x >= end) x = start;  // rounding can leave it on the far face
  };
  const auto outside = [](Edge edge, Real x, Real start, Real end) {
    return edge == Edge::open && (x < start || x > end);
  };
  std::vector<std::int32_t> staying;
  double energy = 0;  // of those that leave
  const std::size_t n = particles_.size();
  staying.reserve(n);
  for (std::size_t k = 0; k < n; ++k) {
    Vec3r x = particles_.position[k];
    into_period(box.x, x.x, low.x, high.x);
    into_period(box.y, x.y, low.y, high.y);
    into_period(box.z, x.z, low.z, high.z);
    particles_.position.set(k, x);
    const bool out =
        outside(box.x, x.x, low.x, high.x) || outside(box.y, x.y, low.y, high.y) || outside(box.z, x.z, low.z, high.z);
    if (out) {
      energy += kinetic(particles_, k);
    } else {
      staying.push_back(static_cast<std::int32_t>(k));
    }
  }
  if (staying.size() == n) return;
  totals_.out += static_cast<std::int64_t>(n - staying.size());
  totals_.energy.out += units_.particle_mass() * energy;
  last_step_.kinetic_energy -= units_.particle_mass() * energy;
  particles_.reorder(staying);
}

void Simulation::let_in_new_layers() {
  const Stopwatch watch(stage_times_, &StageTimes::integration);
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
