#pragma once

#include <span>

#include "sessile/core/parallel.h"
#include "sessile/neighbors/step_view.h"

namespace sessile {

/// Adds to each solid the exact opposite of the force that `law` puts on the liquid, and its torque about the solid's
/// centre. law(i, b) is the acceleration [m/s^2] that boundary particle b gives to fluid particle i: the very law that
/// the force pass sums. Summed in double, the same bits for any number of threads.
template <class Law>
void add_reaction(const StepView& s, const Walls& walls, const Law& law, std::span<SolidForce> forces) {
  if (forces.empty()) return;
  const double unit = s.units.particle_mass();
  const std::size_t solids = forces.size();
  std::vector<SolidForce> parts(static_cast<std::size_t>(block_count(s.n)) * solids);
  for_each_block(s.n, [&](std::ptrdiff_t block, std::ptrdiff_t begin, std::ptrdiff_t end) {
    const std::span<SolidForce> part{parts.data() + static_cast<std::size_t>(block) * solids, solids};
    for (auto i = static_cast<int>(begin); i < static_cast<int>(end); ++i) {
      const double mass = static_cast<double>(s.m[i]) * unit;
      for (int k = 0; k < s.near_walls.count[i]; ++k) {
        const int b = s.near_walls.at(i, k);
        const auto sample = static_cast<std::size_t>(b);
        const auto solid = static_cast<std::size_t>(walls.solid[sample]);
        const Vec3d force = -mass * vec_cast<double>(law(i, b));
        // At the image of b beside i, from which the law took its displacement.
        const Vec3d place = vec_cast<double>(s.x[i]) - vec_cast<double>(s.to_wall(i, b).d);
        part[solid].force += force;
        part[solid].torque += cross(place - walls.centres[solid], force);
      }
    }
  });
  for (std::size_t k = 0; k < parts.size(); ++k) {
    forces[k % solids].force += parts[k].force;
    forces[k % solids].torque += parts[k].torque;
  }
}

}  // namespace sessile
