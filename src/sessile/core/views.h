#pragma once

#include "sessile/core/lanes.h"

/// Arrays as kernels read and write them: one number or vector for an int, a pack for a Group or IndexLanes. Internal.
namespace sessile {

/// Read-only numbers, one per particle: [int] gives one, [Group] those of its particles, [IndexLanes] gathers a pack.
/// Where all are known to be the same, as masses mostly are, a pack needs no gather.
struct View1 {
  const Real* data = nullptr;
  bool all_same = false;

  Real operator[](int i) const { return data[i]; }
  Lanes operator[](Group i) const { return Lanes::load_unaligned(data + i.first); }
  Lanes operator[](const IndexLanes& j) const { return all_same ? Lanes(data[0]) : gather(data, j); }
};

/// Read-only vectors, one per particle.
struct View3 {
  const Real* x = nullptr;
  const Real* y = nullptr;
  const Real* z = nullptr;
  const Real* xy = nullptr;  ///< x and y of each vector in a row once more, to gather both at once, or null

  Vec3r operator[](int i) const { return {x[i], y[i], z[i]}; }
  Vec3<Lanes> operator[](Group i) const {
    return {Lanes::load_unaligned(x + i.first), Lanes::load_unaligned(y + i.first), Lanes::load_unaligned(z + i.first)};
  }
  Vec3<Lanes> operator[](const IndexLanes& j) const {
    if (xy == nullptr) return {gather(x, j), gather(y, j), gather(z, j)};
    const auto [xj, yj] = gather_pairs(xy, j);
    return {xj, yj, gather(z, j)};
  }
};

/// Where a pass puts its numbers, one per particle.
struct Out1 {
  Real* data = nullptr;

  void set(int i, Real value) const { data[i] = value; }
  void set(Group i, const Lanes& value) const { value.store_unaligned(data + i.first); }
};

/// Where a pass puts its vectors, one per particle.
struct Out3 {
  Out1 x, y, z;

  template <ParticleIndex I>
  void set(I i, const Vec3<LaneOf<I>>& value) const {
    x.set(i, value.x), y.set(i, value.y), z.set(i, value.z);
  }
  template <ParticleIndex I>
  void add(I i, const Vec3<LaneOf<I>>& value) const {
    const View3 before{x.data, y.data, z.data};
    set(i, before[i] + value);
  }
};

}  // namespace sessile
