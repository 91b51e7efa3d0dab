#include "sessile/scene/sampling.h"

namespace sessile {

std::vector<Solid> domain_walls(const Domain& domain) {
  const Vec3d size = domain.max - domain.min, centre = 0.5 * (domain.min + domain.max);
  const bool closed_x = domain.x == Edge::closed, closed_y = domain.y == Edge::closed,
             closed_z = domain.z == Edge::closed;
  std::vector<Solid> walls;
  const auto add = [&](const char* label, const SolidShape& shape, const Placement& placement) {
    Solid& wall = walls.emplace_back();
    wall.label = label;
    wall.shape = shape;
    wall.placement = placement;
  };
  if (closed_x && closed_y && closed_z) {
    add("domain", Container{size}, {centre, {0, 0, 1}, 0});
    return walls;
  }
  // A plate faces along its own z axis: turned so that this points into the domain.
  if (closed_x) {
    add("domain_x_min", Plate{size.z, size.y}, {{domain.min.x, centre.y, centre.z}, {0, 1, 0}, 90});
    add("domain_x_max", Plate{size.z, size.y}, {{domain.max.x, centre.y, centre.z}, {0, 1, 0}, -90});
  }
  if (closed_y) {
    add("domain_y_min", Plate{size.x, size.z}, {{centre.x, domain.min.y, centre.z}, {1, 0, 0}, -90});
    add("domain_y_max", Plate{size.x, size.z}, {{centre.x, domain.max.y, centre.z}, {1, 0, 0}, 90});
  }
  if (closed_z) {
    add("domain_z_min", Plate{size.x, size.y}, {{centre.x, centre.y, domain.min.z}, {0, 0, 1}, 0});
    add("domain_z_max", Plate{size.x, size.y}, {{centre.x, centre.y, domain.max.z}, {1, 0, 0}, 180});
  }
  return walls;
}

}  // namespace sessile
