#include "draw/lens.h"

#include <cmath>
#include <numbers>

namespace sessile::draw {

void Lens::set(const gl::Program& program) const {
  program.set("target", target);
  program.set_turn("turn", right, upward, backward);
  program.set("away", away);
  program.set_matrix("projection", projection.data());
  program.set("slope", static_cast<float>(slope_x), static_cast<float>(slope_y));
  program.set("is_parallel", parallel);
}

Lens lens_of(const Camera& camera, double aspect, double radius) {
  Lens lens;
  lens.target = camera.target;
  lens.right = camera.right();
  lens.upward = camera.upward();
  lens.backward = -camera.forward();
  lens.away = camera.distance;
  lens.parallel = camera.orthographic;
  lens.slope_y = std::tan(camera.field_of_view * std::numbers::pi / 360) * (lens.parallel ? camera.distance : 1);
  lens.slope_x = lens.slope_y * aspect;
  lens.projection = camera.projection(aspect, radius);
  return lens;
}

Lens lens_of_light(const Vec3d& towards_light, const Vec3d& centre, double radius) {
  Lens lens;
  lens.target = centre;
  lens.backward = 1 / length(towards_light) * towards_light;
  const Vec3d other = std::abs(lens.backward.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
  lens.right = cross(other, lens.backward);
  lens.right = 1 / length(lens.right) * lens.right;
  lens.upward = cross(lens.backward, lens.right);
  lens.away = radius;
  lens.slope_x = lens.slope_y = radius;
  lens.parallel = true;
  const auto share = static_cast<float>(1 / radius);
  lens.projection = {share, 0, 0, 0, 0, share, 0, 0, 0, 0, -share, 0, 0, 0, -1, 1};
  return lens;
}

}  // namespace sessile::draw
