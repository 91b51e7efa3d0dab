#include "property/energy_bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <variant>

namespace sessile::test {
namespace {

constexpr double most_pull = 10;  // spacings; attraction by solids, which the estimate leaves out, has its room in it
constexpr double most_roundings = 8;  // of a velocity in a step, and of the sums that it comes from

/// Energy that compression stores in WCSPH's liquid [m^2/s^2], by p/rho0 = c^2/gamma (rho^gamma - 1).
double stored(const Wcsph& method, double rho) {
  if (rho <= 1) return 0;
  const double gamma = method.gamma, stiffness = *method.sound_speed * *method.sound_speed / gamma;
  return stiffness * ((std::pow(rho, gamma - 1) - 1) / (gamma - 1) + 1 / rho - 1);
}

/// k and o. docs/reliability.md has what was measured.
struct Bounds {
  double push, overshoot;
};

Bounds bounds_of(const Pressure& solver) {
  if (std::holds_alternative<Pcisph>(solver)) return {1, 8};
  if (std::holds_alternative<Dfsph>(solver)) return {1, 2};
  // Its force lasts for a step, and what it comes of may be spent by then.
  if (std::holds_alternative<Wcsph>(solver)) return {2, 0};
  return {1, 0};
}

}  // namespace

void EnergyBounds::look(const std::vector<Vec3d>& acceleration, double pairs) {
  const Particles& p = simulation_.particles();
  const Scene& scene = simulation_.scene();
  sums_ = {};
  pairs_ = pairs;
  emitted_ = simulation_.totals().energy.emitted;
  const Array3 viscosity = simulation_.acceleration("viscosity");
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto m = static_cast<double>(p.mass[i]), rho = static_cast<double>(simulation_.density()[i]);
    const Vec3d v = vec_cast<double>(p.velocity[i]), a = acceleration[static_cast<std::size_t>(p.id[i])];
    const Vec3d viscous = vec_cast<double>(viscosity[i]), pull = a - scene.gravity - viscous;
    sums_.mass += m;
    sums_.kinetic += m / 2 * squared_length(v);
    sums_.power += m * dot(v, a);
    sums_.square += m / 2 * squared_length(a);
    sums_.pull += m * dot(v, pull);
    sums_.pull_square += m / 2 * dot(a, pull);
    sums_.viscous += m * dot(v, viscous);
    sums_.viscous_size += m * length(v) * length(viscous);
    std::visit(
        [&](const auto& solver) {
          if constexpr (std::is_same_v<std::remove_cvref_t<decltype(solver)>, Wcsph>) {
            sums_.stored += m * stored(solver, rho);
          } else {
            const double c = std::max(0.0, rho - 1) + solver.error;
            sums_.compression += m / 2 * c * c;
          }
          if constexpr (std::is_same_v<std::remove_cvref_t<decltype(solver)>, Dfsph>) {
            const double both = static_cast<double>(p.pressure[i]) + static_cast<double>(p.divergence_pressure[i]);
            sums_.pressure += m / 2 * both * both;
          }
        },
        scene.pressure);
  }
}

std::vector<std::string> EnergyBounds::check() {
  std::vector<std::string> faults;
  const Particles& p = simulation_.particles();
  const double dt = simulation_.last_step().dt, dx = simulation_.units().spacing;
  double energy = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    energy += static_cast<double>(p.mass[i]) / 2 * squared_length(vec_cast<double>(p.velocity[i]));
  }
  const double emitted = (simulation_.totals().energy.emitted - emitted_) / simulation_.units().particle_mass();
  const double without = std::sqrt(std::max(0.0, sums_.kinetic + dt * sums_.power + dt * dt * sums_.square + emitted));
  const double push = std::sqrt(sums_.compression) * std::cbrt(sums_.mass) * dx / dt + std::sqrt(sums_.stored) +
                      std::sqrt(sums_.pressure) * dt / dx;
  const double rounding = most_roundings * std::numeric_limits<Real>::epsilon() *
                          (std::sqrt(sums_.kinetic + emitted) + dt * std::sqrt(sums_.square));
  const double gain = std::sqrt(energy) - without - rounding;
  const Bounds most = bounds_of(simulation_.scene().pressure);
  if (most.overshoot == 0 && gain > 0) worst_push_ = std::max(worst_push_, gain / push);
  if (most.overshoot > 0 && without > 0) worst_overshoot_ = std::max(worst_overshoot_, (gain - push) / without);
  if (!(gain <= most.push * push + most.overshoot * without)) {
    faults.push_back(fmt::format("pressure gives too much energy: sqrt(E) from {:g} to {:g}, compression explains {:g}",
                                 without, std::sqrt(energy), push));
  }
  most_mass_ = std::max(most_mass_, sums_.mass);
  pull_ += dt * sums_.pull + dt * dt * sums_.pull_square;
  if (!simulation_.scene().forces.empty()) {
    const double share = pull_ / (most_mass_ * pairs_ * dx);
    worst_pull_ = std::max(worst_pull_, share);
    if (!(share <= most_pull)) {
      faults.push_back(fmt::format("forces have moved every particle by {:g} dx against the most they give", share));
    }
  }
  const double viscous = sums_.viscous / (most_roundings * std::numeric_limits<Real>::epsilon() * sums_.viscous_size +
                                          std::numeric_limits<double>::min());
  worst_viscosity_ = std::max(worst_viscosity_, viscous);
  if (!(viscous <= 1)) faults.push_back(fmt::format("viscosity gives energy, {:g} times its rounding", viscous));
  return faults;
}

}  // namespace sessile::test
