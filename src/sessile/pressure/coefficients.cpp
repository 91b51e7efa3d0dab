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
  Real* advected;
  Real* diagonal;

  void operator()(int i) const {
    advected[i] = s.rho[i] + dt * rate(i);
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

}  // namespace

void pressure_coefficients(const StepView& s, const Array3& v, double dt, PressureScratch& scratch) {
  scratch.advected.resize(s.n);
  scratch.diagonal.resize(s.n);
  for_each(s.n, CoefficientsKernel{
                    s, {s, view(v), true}, static_cast<Real>(dt), scratch.advected.data(), scratch.diagonal.data()});
}

void advect_density_to_positions(const StepView& s, const Array3& v, double dt, PressureScratch& scratch) {
  scratch.predicted_position.resize(s.n);
  const auto step = static_cast<Real>(dt);
  for_each(s.n, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    scratch.predicted_position.set(k, s.x[i] + step * v[k]);
  });
  StepView after = s;
  after.x = view(scratch.predicted_position);
  compute_density(after, scratch.next);
  constexpr auto most = Real(0.02);
  for_each(s.n, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    scratch.advected[k] += std::clamp(scratch.next[k] - scratch.advected[k], -most, most);
  });
}

void density_change(const StepView& s, const Array3& acceleration, double dt, Array<Real>& change) {
  change.resize(s.n);
  const DensityRate rate{s, view(acceleration), false};
  const auto dt_squared = static_cast<Real>(dt * dt);
  for_each(s.n, [&](int i) { change[static_cast<std::size_t>(i)] = dt_squared * rate(i); });
}

}  // namespace sessile
