#include "property/ledger.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sessile::test {
namespace {

constexpr std::size_t most_faults = 10;
constexpr double most_compression = 0.05;  // after a step, over rest density; errors asked for are up to 0.01
/// Of numbers as the simulation has them, and of the sums in double that are made of n of them here.
double rounding(std::size_t n) {
  return std::numeric_limits<Real>::epsilon() + static_cast<double>(n) * std::numeric_limits<double>::epsilon();
}

bool equal_masses(const Particles& particles) {
  const auto& mass = particles.mass;
  return std::all_of(mass.begin(), mass.end(), [&](Real m) { return m == mass[0]; });
}

/// Whether a force gives the liquid no momentum of its own. Two models say that theirs do with unequal masses.
bool conserves_momentum(const Force& force, const Simulation& simulation) {
  if (std::holds_alternative<Csf>(force)) return false;
  const bool by_equal_masses = std::holds_alternative<Becker2007>(force) || std::holds_alternative<Akinci2013>(force);
  return !by_equal_masses || equal_masses(simulation.particles());
}

/// Whether that share of a force can be told from what solids do, which its acceleration holds too.
bool can_be_told(const Force& force, const Simulation& simulation) {
  const auto* model = std::get_if<Akinci2013>(&force);
  return model == nullptr || model->adhesion == 0 || simulation.walls().size() == 0 ||
         equal_masses(simulation.particles());
}

/// Accelerations of pairs that may cancel in a sum, and so leave their rounding in it [m/s^2].
double pair_acceleration(const Scene& scene, const Units& units) {
  double sum = 0;
  for (const Force& force : scene.forces) {
    sum += std::visit(
        [&](const auto& model) {
          double a = 20 * model.tension(units) / (units.rest_density * units.spacing * units.spacing);
          if constexpr (requires { model.area_minimisation; }) a += 10 * model.area_minimisation;
          if constexpr (requires { model.air_pressure; }) {
            a += 6 * model.air_pressure / (units.rest_density * units.spacing);
          }
          return a;
        },
        force);
  }
  return sum;
}

Vec3d total_force(const Walls& walls) {
  Vec3d sum;
  for (const SolidForce& each : walls.forces) sum += each.force;
  return sum;
}

}  // namespace

Ledger::Ledger(Simulation& simulation)
    : simulation_(simulation),
      bounds_(simulation),
      started_(simulation.particles().size() - static_cast<std::size_t>(simulation.totals().emitted)) {
  energy_scale_ = simulation.totals().energy.start + simulation.totals().energy.emitted;
}

void Ledger::fault(std::string sentence) {
  if (faults_.size() < most_faults) {
    faults_.push_back(fmt::format("step {}, {:g} s: {}", simulation_.totals().steps, simulation_.time(), sentence));
  }
}

Ledger::Before Ledger::look() const {
  const Particles& p = simulation_.particles();
  Before before;
  before.totals = simulation_.totals();
  std::int64_t ids = 0;
  for (const std::int64_t id : p.id) ids = std::max(ids, id + 1);
  before.velocity.resize(static_cast<std::size_t>(ids));
  before.acceleration.resize(static_cast<std::size_t>(ids));
  const auto names = simulation_.acceleration_names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k] == "pressure") continue;
    const Array3 a = simulation_.acceleration(names[k]);
    constexpr std::size_t own = 3;  // gravity, viscosity, pressure
    const bool given = k == 0 || (k >= own && !conserves_momentum(simulation_.scene().forces[k - own], simulation_));
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3d each = vec_cast<double>(a[i]);
      before.acceleration[static_cast<std::size_t>(p.id[i])] += each;
      if (given) before.rate += static_cast<double>(p.mass[i]) * each;
    }
  }
  for (const Force& force : simulation_.scene().forces) {
    before.momentum_is_known = before.momentum_is_known && can_be_told(force, simulation_);
  }
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3d v = vec_cast<double>(p.velocity[i]);
    before.velocity[static_cast<std::size_t>(p.id[i])] = v;
    before.momentum += static_cast<double>(p.mass[i]) * v;
  }
  return before;
}

void Ledger::step() {
  const Before before = look();
  bounds_.look(before.acceleration, pair_acceleration(simulation_.scene(), simulation_.units()));
  simulation_.step();
  check_numbers();
  check_counts(before);
  check_motion(before);
  check_compression(before);
  for (std::string& each : bounds_.check()) fault(std::move(each));
}

void Ledger::check_numbers() {
  const Particles& p = simulation_.particles();
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3r x = p.position[i], v = p.velocity[i], n = simulation_.normal()[i];
    for (const Real value : {x.x, x.y, x.z, v.x, v.y, v.z, n.x, n.y, n.z, p.pressure[i], simulation_.density()[i]}) {
      if (!std::isfinite(value)) {
        fault(fmt::format("particle {} has a number that is not finite", p.id[i]));
        return;
      }
    }
  }
}

void Ledger::check_counts(const Before& before) {
  const Totals& now = simulation_.totals();
  const auto owed = static_cast<std::int64_t>(started_) + now.emitted - now.out;
  if (static_cast<std::int64_t>(simulation_.particles().size()) != owed) {
    fault(fmt::format("{} particles, where {} started, {} were let in and {} left", simulation_.particles().size(),
                      started_, now.emitted, now.out));
  }
  if (now.out < before.totals.out || now.emitted < before.totals.emitted || now.lost < before.totals.lost) {
    fault("a count since the start went down");
  }
}

// Momentum: m v of all changes by gravity (and by forces that do not conserve it), by the opposite of what the liquid
// does to the solids, and by what is let in; what left took an unknown share along, so such steps are
// left out.
// Rounding: each velocity is rounded to eps |v| at each of its two changes, each sum over some 30 neighbours to about
// eps times the sum of its terms' magnitudes. For pressure that sum is below (p_i + p_j) int |grad W| dV < 6 p/dx, for
// the other forces it is estimated by pair_acceleration(); viscosity's is below 10 nu |v|/dx^2, and dt nu/dx^2 < 1/8.
// Errors of one sign throughout would come to the tolerance.
//
// Energy: the account adds up m dt a . (v + v')/2 in double of velocities rounded at each change, so that a step's
// error is eps times the squares of the speeds that occur in it.
void Ledger::check_motion(const Before& before) {
  const Particles& p = simulation_.particles();
  const Units& units = simulation_.units();
  const double dt = simulation_.last_step().dt, dx = units.spacing;
  const double pairs = pair_acceleration(simulation_.scene(), units);
  Vec3d momentum;
  double scale = 0, energy = 0, squares = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto id = static_cast<std::size_t>(p.id[i]);
    const auto m = static_cast<double>(p.mass[i]);
    const Vec3d v = vec_cast<double>(p.velocity[i]);
    momentum += m * v;
    energy += 0.5 * m * squared_length(v);
    const double pressures =
        std::abs(static_cast<double>(p.pressure[i])) + std::abs(static_cast<double>(p.divergence_pressure[i]));
    double speeds = length(v);
    if (id < before.velocity.size()) {
      speeds += length(before.velocity[id]) + dt * length(before.acceleration[id]);
    }
    worst_move_ = std::max(worst_move_, length(v) * dt / dx);
    scale += m * (3 * speeds + dt * (6 * pressures / dx + pairs));
    squares += m * speeds * speeds;
  }
  const Totals& now = simulation_.totals();
  if (now.out == before.totals.out && before.momentum_is_known) {
    Vec3d change =
        momentum - before.momentum - dt * before.rate + dt / units.particle_mass() * total_force(simulation_.walls());
    if (now.emitted > before.totals.emitted) {
      const Emitter& emitter = simulation_.scene().emitters[0];
      change -= static_cast<double>(now.emitted - before.totals.emitted) * emitter.mass_factor * emitter.velocity;
    }
    const double share = length(change) / (rounding(p.size()) * scale);
    worst_momentum_ = std::max(worst_momentum_, share);
    if (!(share <= 1)) {
      fault(fmt::format("momentum is off by {:g} of {:g}, {:g} times its tolerance", length(change), scale, share));
    }
  }
  energy_scale_ += units.particle_mass() * squares;
  energy *= units.particle_mass();
  const double unexplained = std::abs(now.energy.kinetic() - energy);
  const double share = unexplained / (rounding(p.size()) * energy_scale_);
  worst_energy_ = std::max(worst_energy_, share);
  if (!(share <= 1)) {
    fault(fmt::format("kinetic energy {:g} J, its account says {:g} J: {:g} times the tolerance", energy,
                      now.energy.kinetic(), share));
  }
  // Bounded: whatever the forces and pressures, no velocity is worth more than a support radius a step.
  const double most = units.support_radius / dx;
  if (!(worst_move_ <= most)) fault(fmt::format("a particle moves by {:g} dx in a step of {:g} s", worst_move_, dt));
}

void Ledger::check_compression(const Before& before) {
  const StepReport& last = simulation_.last_step();
  const Totals& now = simulation_.totals();
  double sum = 0;
  for (const Real rho : simulation_.density()) sum += std::max(0.0, static_cast<double>(rho) - 1);
  const double mean = sum / static_cast<double>(std::max<std::size_t>(1, simulation_.density().size()));
  worst_density_ = std::max(worst_density_, mean);
  if (!last.converged && now.unconverged_solves == before.totals.unconverged_solves) {
    fault("a solve that did not reach its error is not counted");
  }
  std::visit(
      [&](const auto& solver) {
        // WCSPH is as compressible as its speed of sound says, and promises no error.
        if constexpr (requires { solver.error; }) {
          if (!(mean <= most_compression)) fault(fmt::format("the liquid is compressed by {:g} on average", mean));
          if (last.converged && !(last.predicted_error <= solver.error)) {
            fault(fmt::format("a solve passes for converged with {:g} where {:g} was asked for", last.predicted_error,
                              solver.error));
          }
          if (!last.converged && last.iterations < solver.max_iterations && last.divergence_iterations == 0) {
            fault(fmt::format("a solve gave up after {} of {} iterations", last.iterations, solver.max_iterations));
          }
        }
      },
      simulation_.scene().pressure);
}

}  // namespace sessile::test
