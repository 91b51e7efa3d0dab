#include "sessile/misplaced.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "sessile/neighbors/neighbors.h"

namespace sessile {
namespace {

// Particles this close to each other or to a boundary particle at the start would be flung apart [dx].
constexpr double least_distance = 0.5;
constexpr std::size_t most_told = 100;

bool outside(const Domain& domain, const Vec3d& x) {
  const Vec3d low = domain.min, high = domain.max;
  return x.x < low.x || x.x > high.x || x.y < low.y || x.y > high.y || x.z < low.z || x.z > high.z;
}

}  // namespace

std::vector<std::string> misplaced(const Array3& points, const std::vector<std::size_t>& owner,
                                   const std::vector<std::string>& names, const Surroundings& around) {
  const std::vector<SolidGeometry>& solids = around.solids;
  const Walls& walls = around.walls;
  std::set<std::string> faults;
  Grid grid;
  grid.build(points, around.shape);
  Array3 sorted;
  for (const std::int32_t k : grid.order()) sorted.push_back(points[static_cast<std::size_t>(k)]);
  const auto close = static_cast<Real>(least_distance * around.scene.spacing);
  const auto owner_at = [&](std::size_t place) { return owner[static_cast<std::size_t>(grid.order()[place])]; };
  NeighborList pairs, touches;
  std::map<std::string, std::size_t> in_solids;  // "bodies[0] ... in the solid x" -> particles
  std::map<std::string, std::size_t> out_of_domain;
  // Many bodies at one place make more pairs than there is memory for: a part at a time, until enough is found.
  for (const PlaceRange& part :
       parts_of(sorted.size(), std::max(grid.fullest_cell(), around.wall_grid.fullest_cell()))) {
    if (faults.size() > most_told || in_solids.size() > most_told || out_of_domain.size() > most_told) break;
    pairs.build({sorted, grid}, {sorted, grid}, around.space, close, part);
    touches.build({sorted, grid}, {walls.position, around.wall_grid}, around.space, close, part);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const std::size_t place = static_cast<std::size_t>(part.begin) + k, mine = owner_at(place);
      for (const std::int32_t other : pairs[k]) {
        const std::size_t theirs = owner_at(static_cast<std::size_t>(other));
        if (mine < theirs && faults.size() <= most_told) {
          faults.insert(fmt::format("{} and {} overlap", names[mine], names[theirs]));
        }
      }
      const Vec3d x = vec_cast<double>(sorted[place]);
      std::ptrdiff_t solid =
          std::find_if(solids.begin(), solids.end(), [&](const auto& s) { return s.contains(x); }) - solids.begin();
      if (solid == static_cast<std::ptrdiff_t>(solids.size()) && touches.count(k) > 0) {
        solid = walls.solid[static_cast<std::size_t>(touches[k][0])];
      }
      if (solid < static_cast<std::ptrdiff_t>(solids.size())) {
        ++in_solids[fmt::format("{} starts inside the solid \"{}\"", names[mine],
                                walls.labels[static_cast<std::size_t>(solid)])];
      }
      if (around.scene.domain && outside(*around.scene.domain, x)) {
        ++out_of_domain[fmt::format("{} starts outside the domain", names[mine])];
      }
    }
  }
  for (const auto* found : {&in_solids, &out_of_domain}) {
    for (const auto& [what, count] : *found) faults.insert(fmt::format("{} ({} of its particles)", what, count));
  }
  std::vector<std::string> told(faults.begin(), faults.end());
  if (told.size() > most_told) {
    told.resize(most_told);
    told.push_back(fmt::format("more than {} such faults", most_told));
  }
  return told;
}

}  // namespace sessile
