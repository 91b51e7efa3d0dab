#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>

#include "sessile/core/array.h"

namespace sessile {

/// The fluid's particles as a structure of arrays. Holds what must survive from step to step, and nothing else:
/// what a step derives (density, normals, accelerations) belongs to the Simulation.
struct Particles {
  Array3 position;                  ///< [m]
  Array3 velocity;                  ///< [m/s]
  Array<Real> mass;                 ///< in units of rho0 dx^3, so that no product leaves float's range at any scale
  Array<Real> pressure;             ///< p / rho0 [m^2/s^2]; the warm start of the next solve
  Array<Real> mean_pressure;        ///< mean of that over the last steps, where a solver keeps one
  Array<Real> divergence_pressure;  ///< the same of the solver that frees velocities of divergence, where there is one
  Array<std::int64_t> id;           ///< 0, 1, 2 ... in order of appearance; never reused

  /// Calls f(array) for each array above: the only place that lists them all.
  template <class F>
  void for_each_field(F&& f) {
    visit(*this, f);
  }
  template <class F>
  void for_each_field(F&& f) const {
    visit(*this, f);
  }

  std::size_t size() const { return id.size(); }
  std::size_t bytes() const;
  void resize(std::size_t n);

  /// Appends one particle at rest pressure.
  void add(const Vec3r& position, const Vec3r& velocity, Real mass, std::int64_t id);

  /// Puts particle order[k] at place k, for all k. `order` may name fewer particles than there are: the others go.
  void reorder(std::span<const std::int32_t> order);

 private:
  template <class P, class F>
  static void visit(P& particles, F&& f) {
    f(particles.position.x);
    f(particles.position.y);
    f(particles.position.z);
    f(particles.velocity.x);
    f(particles.velocity.y);
    f(particles.velocity.z);
    f(particles.mass);
    f(particles.pressure);
    f(particles.mean_pressure);
    f(particles.divergence_pressure);
    f(particles.id);
  }

  std::tuple<Array<Real>, Array<std::int64_t>> reorder_scratch_;  // one for each type of a field
};

/// Kinetic energy of a particle in units of a particle mass of rho0 dx^3 [m^2/s^2].
inline double kinetic(const Particles& particles, std::size_t k) {
  return 0.5 * static_cast<double>(particles.mass[k]) * squared_length(vec_cast<double>(particles.velocity[k]));
}

}  // namespace sessile
