#pragma once

#include <algorithm>

#include "sessile/core/parallel.h"
#include "sessile/neighbors/step_view.h"
#include "sessile/pressure/solve.h"

/// What every pressure solver measures: how a motion changes the density, and how much compression is left. Internal.
namespace sessile {

/// sum_j m_j (u_i - u_j) . grad W_ij + sum_b psi_b (u_i - u_b) . grad W_ib: the rate at which a motion u raises the
/// density of i. `walls_move` leaves out u_b where the walls have no part in the motion.
struct DensityRate {
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

/// Enters the average and the greatest of compression(i) = max(0, rho_i - rho0)/rho0 into a result.
template <class Compression>
void measure_error(std::size_t n, const Compression& compression, PressureResult& result) {
  struct Left {
    double sum = 0, greatest = 0;
  };
  const Left left = reduce(
      n, Left{},
      [&](int i) {
        const auto c = static_cast<double>(compression(i));
        return Left{c, c};
      },
      [](const Left& a, const Left& b) {
        return Left{a.sum + b.sum, std::max(a.greatest, b.greatest)};
      });
  result.error = n == 0 ? 0 : left.sum / static_cast<double>(n);
  result.error_max = left.greatest;
}

}  // namespace sessile
