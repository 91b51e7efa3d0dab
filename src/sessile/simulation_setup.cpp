#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sessile/core/error.h"
#include "sessile/core/memory_limit.h"
#include "sessile/forces/viscosity.h"
#include "sessile/foreign_state.h"
#include "sessile/misplaced.h"
#include "sessile/neighbors/step_view.h"
#include "sessile/pressure/pressure_force.h"
#include "sessile/scene/lattice.h"
#include "sessile/scene/tuning.h"
#include "sessile/scene/validate.h"
#include "sessile/simulation.h"

namespace sessile {
namespace {

double estimate_bodies(const Scene& scene) {
  double particles = 0;
  for (const Body& body : scene.bodies) particles += estimate_fill(body, scene.spacing);
  return particles;
}

/// `liquid`: its particles at the start, where they are known already.
void refuse_what_does_not_fit(const Scene& scene, std::optional<double> liquid) {
  double particles = liquid ? *liquid : estimate_bodies(scene);
  for (const Emitter& emitter : scene.emitters) particles += estimate_layer(emitter, scene.spacing);
  for (const Solid& solid : scene.solids) particles += estimate_surface(solid, scene.spacing);
  if (scene.domain) {
    for (const Solid& wall : domain_walls(*scene.domain)) particles += estimate_surface(wall, scene.spacing);
  }
  const MemoryLimit memory = memory_limit();
  const double needed = estimated_bytes(particles, scene.support);
  if (!(needed <= memory.bytes)) {
    throw SceneError(
        fmt::format("the scene needs about {:.3g} particles and boundary particles, that is {:.3g} GiB; {} {:.3g} GiB "
                    "(a larger spacing needs fewer)",
                    particles, needed / (1 << 30), memory.what, memory.bytes / (1 << 30)));
  }
  check_count(particles, "the scene, with its boundary particles,");
}

std::string name_of(const std::string& label, const char* kind, std::size_t index) {
  return label.empty() ? fmt::format("{}[{}]", kind, index) : fmt::format("{}[{}] \"{}\"", kind, index, label);
}

Space make_space(const Scene& scene) {
  Space space;
  if (!scene.domain) return space;
  const Domain& box = *scene.domain;
  const auto set = [&](Edge edge, double length, Real& period, Real& inverse) {
    if (edge != Edge::periodic) return;
    period = static_cast<Real>(length);
    inverse = static_cast<Real>(1 / length);
    space.periodic = true;
  };
  const Vec3d size = box.max - box.min;
  set(box.x, size.x, space.period.x, space.inverse_period.x);
  set(box.y, size.y, space.period.y, space.inverse_period.y);
  set(box.z, size.z, space.period.z, space.inverse_period.z);
  return space;
}

/// The scene's solids and, after them, the domain's own walls.
std::vector<Solid> all_solids(const Scene& scene) {
  std::vector<Solid> solids = scene.solids;
  if (scene.domain) {
    for (Solid& wall : domain_walls(*scene.domain)) solids.push_back(std::move(wall));
  }
  return solids;
}

/// Greatest speed [m/s] that the liquid can be expected to reach, or to be pressed as if it had: that of the start, of
/// the fall from its highest place to the lowest boundary particle, and of the pressure 8 sigma/h that cohesion over a
/// support radius h puts a liquid under (8.23 for the cohesion spline and unit vectors, by the integrals).
///   sqrt( v^2 + 2 g H + 16 sigma/(rho0 h) )
double expected_speed(const Scene& scene, const Array3& liquid, const Walls& walls, double start_speed,
                      double tension) {
  const double g = length(scene.gravity);
  double fall = 0;
  if (g > 0) {
    const auto height = [&](const Vec3r& x) { return -dot(vec_cast<double>(x), scene.gravity) / g; };
    double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
    for (std::size_t k = 0; k < liquid.size(); ++k) {
      highest = std::max(highest, height(liquid[k]));
      lowest = std::min(lowest, height(liquid[k]));
    }
    for (std::size_t k = 0; k < walls.size(); ++k) lowest = std::min(lowest, height(walls.position[k]));
    fall = std::max(0.0, highest - lowest);
  }
  return std::sqrt(start_speed * start_speed + 2 * g * fall +
                   16 * tension / (scene.fluid.rest_density * scene.support_radius()));
}

}  // namespace

void Simulation::set_up_surroundings(std::optional<double> liquid) {
  std::vector<std::string> invalid;
  for (const Fault& fault : validate(scene_)) invalid.push_back(text(fault));
  if (!invalid.empty()) throw SceneError(std::move(invalid));
  refuse_what_does_not_fit(scene_, liquid);
  units_ = {scene_.spacing, scene_.support_radius(), scene_.fluid.rest_density};
  space_ = make_space(scene_);
  grid_shape_ = GridShape::make(units_.support_radius, scene_.domain ? scene_.domain->min : Vec3d{},
                                vec_cast<double>(space_.period));

  const std::vector<Solid> solids = all_solids(scene_);
  walls_ = make_walls(solids, scene_, grid_shape_, space_, wall_grid_);
  for (const Solid& solid : solids) {
    solids_.emplace_back(solid);
    // Those that domain_walls() adds stand behind the scene's own.
    holds_liquid_.push_back(solids_.size() > scene_.solids.size() || std::holds_alternative<Container>(solid.shape));
    coarse_walls_ = coarse_walls_ || solid.spacing.value_or(scene_.spacing) > 1.001 * scene_.spacing;
  }
  for (const Emitter& emitter : scene_.emitters) sources_.emplace_back(emitter, scene_.spacing, space_);
}

void Simulation::fill_bodies() {
  std::vector<std::size_t> owner;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < scene_.bodies.size(); ++k) {
    const Body& body = scene_.bodies[k];
    names.push_back(name_of(body.label, "bodies", k));
    const std::vector<Vec3d> places = fill(body, scene_.spacing);
    check_count(static_cast<double>(particles_.size() + places.size()), "the scene's bodies");
    for (const Vec3d& place : places) {
      const Vec3d velocity = body.velocity + cross(body.spin, place - body.placement.position);
      particles_.add(vec_cast<Real>(place), vec_cast<Real>(velocity), static_cast<Real>(body.mass_factor), next_id_++);
      owner.push_back(names.size() - 1);
    }
  }
  // A layer may appear where a body starts: it waits. But it cannot appear in a solid.
  const Surroundings around{scene_, walls_, solids_, wall_grid_, grid_shape_, space_};
  auto faults = misplaced(particles_.position, owner, names, around);
  for (std::size_t k = 0; k < scene_.emitters.size(); ++k) {
    const Array3& places = sources_[k].places();
    for (auto& fault : misplaced(places, std::vector<std::size_t>(places.size(), 0),
                                 {name_of(scene_.emitters[k].label, "emitters", k)}, around)) {
      faults.push_back(std::move(fault));
    }
  }
  if (!faults.empty()) throw SceneError(std::move(faults));
}

Simulation::Simulation(Scene scene) : scene_(std::move(scene)) {
  set_up_surroundings({});
  fill_bodies();
  settle_sound_speed(particles_.position);
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    totals_.energy.start += 0.5 * units_.particle_mass() * static_cast<double>(particles_.mass[k]) *
                            squared_length(vec_cast<double>(particles_.velocity[k]));
  }
  last_step_.kinetic_energy = totals_.energy.start;
  let_in_new_layers();
  look_around();
}

Simulation::Simulation(Scene scene, SimulationState state) : scene_(std::move(scene)) {
  set_up_surroundings(static_cast<double>(state.particles.size()));
  take_over(std::move(state));
}

void Simulation::go_back_to(const SimulationState& state) {
  pressure_ = {};  // what went wrong may have left numbers there that are not finite
  health_ = {};
  take_over(state);
}

void Simulation::take_over(SimulationState state) {
  refuse_foreign(state, scene_, walls_);
  time_ = state.time;
  particles_ = std::move(state.particles);
  next_id_ = state.next_id;
  for (std::size_t k = 0; k < sources_.size(); ++k) sources_[k].go_on_from(state.sources[k]);
  walls_.forces = std::move(state.forces);
  last_step_ = state.last_step;
  totals_ = state.totals;
  look_around();  // the particles are in the grid's order already, and stay so
  stage_times_ = state.stage_times;
}

SimulationState Simulation::state() const {
  SimulationState state{time_,          particles_, next_id_, {},          walls_.forces,
                        digest(walls_), last_step_, totals_,  stage_times_};
  for (const LayerSource& source : sources_) state.sources.push_back(source.progress());
  return state;
}

void Simulation::settle_sound_speed(Array3 liquid) {
  auto* method = std::get_if<Wcsph>(&scene_.pressure);
  if (method == nullptr || method->sound_speed) return;
  for (const LayerSource& source : sources_) {
    for (std::size_t k = 0; k < source.places().size(); ++k) liquid.push_back(source.places()[k]);
  }
  double start_speed = 0;
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    start_speed = std::max(start_speed, static_cast<double>(length(particles_.velocity[k])));
  }
  for (const Emitter& emitter : scene_.emitters) start_speed = std::max(start_speed, length(emitter.velocity));
  method->sound_speed = 10 * expected_speed(scene_, liquid, walls_, start_speed, tension());
  if (*method->sound_speed == 0) {
    throw SceneError(
        "pressure.sound_speed: nothing moves, falls or pulls the liquid at the start, so that no speed of sound "
        "follows; "
        "give one");
  }
}

double Simulation::tension() const {
  double sum = 0;
  for (const Force& force : scene_.forces) {
    sum += std::visit([&](const auto& model) { return model.tension(units_); }, force);
  }
  return sum;
}

void Simulation::retune(Scene scene) {
  std::vector<std::string> faults;
  for (const Fault& fault : validate(scene)) faults.push_back(text(fault));
  for (const std::string& path : differing_parameters(tuned(scene_, scene), scene)) {
    faults.push_back(path + ": cannot change while the simulation runs, only from its start");
  }
  if (!faults.empty()) throw SceneError(std::move(faults));
  if (auto* method = std::get_if<Wcsph>(&scene.pressure); method != nullptr && !method->sound_speed) {
    method->sound_speed = std::get<Wcsph>(scene_.pressure).sound_speed;
  }
  scene_ = std::move(scene);
  set_materials(all_solids(scene_), scene_.fluid, walls_);
  find_normals();
}

std::vector<std::string> Simulation::acceleration_names() const {
  std::vector<std::string> names{"gravity", "viscosity", "pressure"};
  for (const Force& force : scene_.forces) {
    const auto kind = force.index();
    const auto same = std::count_if(scene_.forces.data(), &force, [&](const Force& f) { return f.index() == kind; });
    const std::string name = std::visit([](const auto& model) { return std::string(model.name); }, force);
    names.push_back(same == 0 ? name : fmt::format("{}_{}", name, same + 1));
  }
  return names;
}

Array3 Simulation::acceleration(std::string_view name) const {
  const StepView s = view();
  Array3 a;
  a.assign(s.n, name == "gravity" ? vec_cast<Real>(scene_.gravity) : Vec3r{});
  if (name == "viscosity") add_viscosity(s, scene_.fluid.viscosity, a);
  if (name == "pressure") {
    Array<Real> stress;
    pressure_acceleration(s, particles_.pressure, stress, a);
  }
  const std::vector<std::string> names = acceleration_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw Error(fmt::format("no acceleration is called \"{}\"", name));
  constexpr std::ptrdiff_t own = 3;  // gravity, viscosity and pressure come before the scene's forces
  if (found - names.begin() >= own) {
    std::visit([&](const auto& model) { model.add_acceleration(s, a); },
               scene_.forces[static_cast<std::size_t>(found - names.begin() - own)]);
  }
  return a;
}

std::size_t Simulation::bytes() const {
  const auto total = [](const auto&... arrays) { return (bytes_of(arrays) + ...); };
  return particles_.bytes() + walls_.bytes() + grid_.bytes() + wall_grid_.bytes() + fluid_neighbors_.bytes() +
         wall_neighbors_.bytes() + total(density_, normal_, acceleration_, position_pairs_, pairs_) + pressure_.bytes();
}

}  // namespace sessile
