#include <algorithm>
#include <tuple>

#include "sessile/particles/density.h"
#include "sessile/pressure/density_rate.h"

namespace sessile {
namespace {

/// rho_adv (27) and a_ii (34, with d_ji). As d_ji = dt^2 (m_i/rho_i^2) grad W_ij and
/// d_ii = -dt^2/rho_i^2 g_i with g_i = sum_j m_j grad W_ij + sum_b psi_b grad W_ib, (34) closes to
///   a_ii = -dt^2/rho_i^2 ( |g_i|^2 + m_i sum_j m_j |grad W_ij|^2 )
struct CoefficientsKernel {
  StepView s;
  DensityRate rate;  // of v*
  Real dt;
  Out1 advected, diagonal;

  template <ParticleIndex I>
  void operator()(I i) const {
    const auto [rate_fluid, g_fluid, squares] = s.near.sum(i, [&](auto j) {
      const auto gradient = s.W.gradient(s.to_fluid(i, j));
      return std::tuple{rate.fluid(i, j, gradient), s.m[j] * gradient, s.m[j] * squared_length(gradient)};
    });
    const auto [rate_walls, g_walls] = s.near_walls.sum(i, [&](auto b) {
      const auto gradient = s.W.gradient(s.to_wall(i, b));
      return std::tuple{rate.wall(i, b, gradient), s.walls.psi[b] * gradient};
    });
    advected.set(i, s.rho[i] + dt * (rate_fluid + rate_walls));
    const LaneOf<I> step_over_density = LaneOf<I>(dt) / s.rho[i];
    diagonal.set(i, -step_over_density * step_over_density * (squared_length(g_fluid + g_walls) + s.m[i] * squares));
  }
};

}  // namespace

void pressure_coefficients(const StepView& s, const Array3& v, double dt, PressureScratch& scratch) {
  scratch.advected.resize(s.n);
  scratch.diagonal.resize(s.n);
  s.for_each_particle(CoefficientsKernel{
      s, {s, s.paired(view(v)), true}, static_cast<Real>(dt), out(scratch.advected), out(scratch.diagonal)});
}

void advect_density_to_positions(const StepView& s, const Array3& v, double dt, PressureScratch& scratch) {
  scratch.predicted_position.resize(s.n);
  const auto step = static_cast<Real>(dt);
  for_each(s.n, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    scratch.predicted_position.set(k, s.x[i] + step * v[k]);
  });
  StepView after = s;
  after.x = s.paired(view(scratch.predicted_position));
  compute_density(after, scratch.next);
  constexpr auto most = Real(0.02);
  for_each(s.n, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    scratch.advected[k] += std::clamp(scratch.next[k] - scratch.advected[k], -most, most);
  });
}

void density_change(const StepView& s, const Array3& acceleration, double dt, Array<Real>& change) {
  change.resize(s.n);
  const DensityRate rate{s, s.paired(view(acceleration)), false};
  const auto dt_squared = static_cast<Real>(dt * dt);
  const Out1 each = out(change);
  s.for_each_particle([&](auto i) { each.set(i, dt_squared * rate(i)); });
}

}  // namespace sessile
