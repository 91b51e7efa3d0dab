#include "sessile/pressure/iisph.h"

#include <tuple>

#include "sessile/core/parallel.h"
#include "sessile/neighbors/step_view.h"
#include "sessile/pressure/pressure_force.h"
#include "sessile/pressure/solve.h"

namespace sessile {
namespace {

/// sum_j m_j (u_i - u_j) . grad W_ij + sum_b psi_b (u_i - u_b) . grad W_ib: the rate at which a motion u raises the
/// density of i. `walls_move` leaves out u_b where the walls have no part in the motion.
struct Compression {
  StepView s;
  View3 u;
  bool walls_move;

  Real operator()(int i) const {
    const auto ui = u[i];
    const Real fluid = s.near.sum(i, [&](auto j) {
      using T = LaneOf<decltype(j)>;
      const auto pair = s.to_fluid(i, j);
      return s.m[j] * dot(spread<T>(ui) - u[j], s.W.gradient(pair));
    });
    const Real walls = s.near_walls.sum(i, [&](auto b) {
      using T = LaneOf<decltype(b)>;
      const auto pair = s.to_wall(i, b);
      const auto relative = walls_move ? spread<T>(ui) - s.walls.v[b] : spread<T>(ui);
      return s.walls.psi[b] * dot(relative, s.W.gradient(pair));
    });
    return fluid + walls;
  }
};

/// rho_adv (27) and a_ii (34, with d_ji). As d_ji = dt^2 (m_i/rho_i^2) grad W_ij and
/// d_ii = -dt^2/rho_i^2 g_i with g_i = sum_j m_j grad W_ij + sum_b psi_b grad W_ib, (34) closes to
///   a_ii = -dt^2/rho_i^2 ( |g_i|^2 + m_i sum_j m_j |grad W_ij|^2 )
struct CoefficientsKernel {
  StepView s;
  Compression compression;  // of v*
  Real dt;
  Real* advected;
  Real* diagonal;

  void operator()(int i) const {
    advected[i] = s.rho[i] + dt * compression(i);
    const auto [g_fluid, squares] = s.near.sum(i, [&](auto j) {
      const auto pair = s.to_fluid(i, j);
      const auto gradient = s.W.gradient(pair);
      return std::tuple{s.m[j] * gradient, s.m[j] * squared_length(gradient)};
    });
    const auto g_walls = s.near_walls.sum(i, [&](auto b) {
      const auto pair = s.to_wall(i, b);
      return s.walls.psi[b] * s.W.gradient(pair);
    });
    const Real step_over_density = dt / s.rho[i];
    diagonal[i] = -step_over_density * step_over_density * (squared_length(g_fluid + g_walls) + s.m[i] * squares);
  }
};

/// One relaxed Jacobi step (35) on p_i, and the compression that p^l leaves at i.
///   p^{l+1} = p^l + (omega/a_ii) ( rho0 - rho_adv - (A p^l)_i ),  clamped to p >= 0
struct RelaxationKernel {
  Compression compression;  // of a^p
  Real dt_squared, relaxation;
  const Real* advected;
  const Real* diagonal;
  const Real* p;
  Real* next;

  double operator()(int i) const {
    const Real predicted = advected[i] + dt_squared * compression(i);
    const Real a_ii = diagonal[i];
    next[i] = a_ii < 0 ? max(p[i] + relaxation / a_ii * (1 - predicted), Real(0)) : Real(0);
    return static_cast<double>(max(predicted - 1, Real(0)));
  }
};

struct Compressions {
  double sum = 0, greatest = 0;
};

}  // namespace

void iisph_coefficients(const StepView& s, const Array3& v, double dt, PressureScratch& scratch) {
  scratch.advected.resize(s.n);
  scratch.diagonal.resize(s.n);
  for_each(s.n, CoefficientsKernel{
                    s, {s, view(v), true}, static_cast<Real>(dt), scratch.advected.data(), scratch.diagonal.data()});
}

void iisph_density_change(const StepView& s, const Array3& acceleration, double dt, Array<Real>& change) {
  change.resize(s.n);
  const Compression compression{s, view(acceleration), false};
  const auto dt_squared = static_cast<Real>(dt * dt);
  for_each(s.n, [&](int i) { change[static_cast<std::size_t>(i)] = dt_squared * compression(i); });
}

PressureResult solve(const Iisph& method, const StepView& s, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch) {
  PressureResult result;
  scratch.acceleration.resize(s.n);
  if (s.n == 0) return {0, true, 0, 0};
  iisph_coefficients(s, predicted_velocity, dt, scratch);
  const auto share = static_cast<Real>(method.warm_start);
  for_each(s.n, [&](int i) { pressure[static_cast<std::size_t>(i)] *= share; });

  // Each turn measures what the pressures at hand leave, and improves them. It ends with pressures whose own error was
  // measured, and with their acceleration.
  scratch.next.resize(s.n);
  while (true) {
    pressure_acceleration(s, pressure, scratch.stress, scratch.acceleration);
    const RelaxationKernel relax{{s, view(scratch.acceleration), false},
                                 static_cast<Real>(dt * dt),
                                 static_cast<Real>(method.relaxation),
                                 scratch.advected.data(),
                                 scratch.diagonal.data(),
                                 pressure.data(),
                                 scratch.next.data()};
    const auto left = reduce(
        s.n, Compressions{},
        [&](int i) {
          const double compression = relax(i);
          return Compressions{compression, compression};
        },
        [](const Compressions& a, const Compressions& b) {
          return Compressions{a.sum + b.sum, std::max(a.greatest, b.greatest)};
        });
    ++result.iterations;
    result.error = left.sum / static_cast<double>(s.n);
    result.error_max = left.greatest;
    result.converged = result.error <= method.error && result.iterations >= method.min_iterations;
    if (result.converged || result.iterations >= method.max_iterations) return result;
    pressure.swap(scratch.next);
  }
}

PressureResult solve(const Pressure& method, const StepView& s, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch) {
  return std::visit([&](const auto& chosen) { return solve(chosen, s, predicted_velocity, dt, pressure, scratch); },
                    method);
}

}  // namespace sessile
