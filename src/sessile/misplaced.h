#pragma once

#include <string>
#include <vector>

#include "sessile/core/space.h"
#include "sessile/neighbors/grid.h"
#include "sessile/scene/sampling.h"
#include "sessile/walls/walls.h"

namespace sessile {

/// What liquid is set into.
struct Surroundings {
  const Scene& scene;
  const Walls& walls;
  const std::vector<SolidGeometry>& solids;
  const Grid& wall_grid;
  const GridShape& shape;
  const Space& space;
};

/// Says which bodies overlap, and which liquid starts inside a solid or outside the domain: a hundred of these at most,
/// and that there are more. `owner` numbers the body or emitter of each point, `names` names it.
std::vector<std::string> misplaced(const Array3& points, const std::vector<std::size_t>& owner,
                                   const std::vector<std::string>& names, const Surroundings& around);

}  // namespace sessile
