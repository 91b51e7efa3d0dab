#pragma once

#include "sessile/core/array.h"
#include "sessile/core/space.h"
#include "sessile/core/units.h"
#include "sessile/core/views.h"
#include "sessile/kernels/cubic_spline.h"
#include "sessile/neighbors/neighbor_view.h"
#include "sessile/particles/particles.h"
#include "sessile/walls/walls.h"

namespace sessile {

inline View1 view(const Array<Real>& a) { return {a.data()}; }
inline View3 view(const Array3& a) { return {a.x.data(), a.y.data(), a.z.data()}; }
inline Out1 out(Array<Real>& a) { return {a.data()}; }
inline Out3 out(Array3& a) { return {{a.x.data()}, {a.y.data()}, {a.z.data()}}; }

/// Writes x and y of each vector in a row to `xy`.
inline void pair_up(const View3& field, std::size_t n, Real* xy) {
  for_each_block(n, [=](std::ptrdiff_t, std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (auto i = begin; i < end; ++i) xy[2 * i] = field.x[i], xy[2 * i + 1] = field.y[i];
  });
}

/// What a pair law may read: particles, boundary particles and neighbours at one moment. Internal; costs nothing to
/// copy. Masses and psi are in units of rho0 dx^3, densities of rho0, kernels of 1/dx^3, pressures p / rho0 [m^2/s^2].
struct StepView {
  struct Samples {
    View3 x, v;
    View1 psi, adhesion, viscosity;
  };

  std::size_t n = 0;
  Units units;
  CubicSpline W;
  Space space;
  View3 x, v;
  View1 m;
  View1 rho;                // valid once compute_density has run
  View3 normal;             // valid once compute_normals has run
  NeighborView near;        // fluid around a fluid particle
  NeighborView near_walls;  // boundary particles around a fluid particle
  Samples walls;
  Real* pairs = nullptr;  // memory for paired(): 2 n numbers, or null where a pass is to gather one by one
  bool one_lane = false;  // one particle at a time, as plain numbers: the reference that tests hold lanes against

  StepView() = default;
  StepView(const Units& in, const Space& where, const Particles& particles, const Walls& solids,
           const NeighborList& fluid, const NeighborList& boundary)
      : n(particles.size()),
        units(in),
        W(in.support_radius, in.spacing),
        space(where),
        x(view(particles.position)),
        v(view(particles.velocity)),
        m(view(particles.mass)),
        near(fluid),
        near_walls(boundary),
        walls{view(solids.position), view(solids.velocity), view(solids.psi), view(solids.adhesion),
              view(solids.viscosity)} {}

  /// How i lies to a fluid particle, and to a boundary particle.
  template <ParticleIndex I, NeighborIndex J>
  auto to_fluid(I i, const J& j) const {
    return Separation<LaneOf<I>>(space.displacement(x[i], x[j]));
  }
  template <ParticleIndex I, NeighborIndex J>
  auto to_wall(I i, const J& b) const {
    return Separation<LaneOf<I>>(space.displacement(x[i], walls.x[b]));
  }

  /// A field of vectors for a pass to gather from, faster where there is memory for it; until the next call.
  View3 paired(View3 field) const {
    if (pairs == nullptr) return field;
    pair_up(field, n, pairs);
    field.xy = pairs;
    return field;
  }

  /// Calls kernel(i) for all particles, on all threads: i is a Group, or an int where one lane is wanted.
  template <class Kernel>
  void for_each_particle(const Kernel& kernel) const {
    if (one_lane) {
      for_each(n, kernel);
    } else {
      for_each_group(n, kernel);
    }
  }
};

}  // namespace sessile
