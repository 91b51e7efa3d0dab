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

  template <ParticleIndex I>
  LaneOf<I> operator()(I i) const {
    return s.near.sum(i, [&](auto j) { return fluid(i, j, s.W.gradient(s.to_fluid(i, j))); }) +
           s.near_walls.sum(i, [&](auto b) { return wall(i, b, s.W.gradient(s.to_wall(i, b))); });
  }

  /// What one pair adds, its gradient at hand.
  template <ParticleIndex I, NeighborIndex J>
  LaneOf<I> fluid(I i, const J& j, const Vec3<LaneOf<I>>& gradient) const {
    return s.m[j] * dot(u[i] - u[j], gradient);
  }
  template <ParticleIndex I, NeighborIndex J>
  LaneOf<I> wall(I i, const J& b, const Vec3<LaneOf<I>>& gradient) const {
    return s.walls.psi[b] * dot(walls_move ? u[i] - s.walls.v[b] : u[i], gradient);
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
