#pragma once

#include "sessile/core/parallel.h"
#include "sessile/neighbors/step_view.h"

/// What the pair laws of several forces have in common. Internal.
namespace sessile {

/// x_ij / r, or 0 for coincident particles.
template <class T>
Vec3<T> unit_vector(const Separation<T>& pair) {
  return pair.inverse_r * pair.d;
}

/// n_i - n_j, or 0 for coincident particles: rounding must not push them.
template <ParticleIndex I, NeighborIndex J>
auto normal_difference(const StepView& s, I i, const J& j, const Separation<LaneOf<I>>& pair) {
  using T = LaneOf<I>;
  const T apart = select(squared_length(pair.d) > T(Real(0)), T(Real(1)), T(Real(0)));
  return apart * (s.normal[i] - s.normal[j]);
}

/// Adds what `fluid` sums to over the liquid around each particle.
template <class Fluid>
void add_sums(const StepView& s, const Fluid& fluid, Array3& acceleration) {
  const Out3 a = out(acceleration);
  s.for_each_particle([&](auto i) { a.add(i, s.near.sum(i, [&](auto j) { return fluid(i, j); })); });
}

/// Adds what `fluid` sums to over the liquid around each particle and `wall` over the boundary particles.
template <class Fluid, class Wall>
void add_sums(const StepView& s, const Fluid& fluid, const Wall& wall, Array3& acceleration) {
  const Out3 a = out(acceleration);
  s.for_each_particle([&](auto i) {
    a.add(i,
          s.near.sum(i, [&](auto j) { return fluid(i, j); }) + s.near_walls.sum(i, [&](auto b) { return wall(i, b); }));
  });
}

}  // namespace sessile
