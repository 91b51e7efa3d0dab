#pragma once

#include "sessile/core/vec.h"
#include "sessile/scene/shapes.h"

namespace sessile {

/// A placement worked out once, for many points.
class Frame {
 public:
  explicit Frame(const Placement& placement);

  Vec3d turn(const Vec3d& v) const { return v.x * x_ + v.y * y_ + v.z * z_; }
  Vec3d to_world(const Vec3d& local) const { return position_ + turn(local); }
  Vec3d to_local(const Vec3d& world) const {
    const Vec3d d = world - position_;
    return {dot(d, x_), dot(d, y_), dot(d, z_)};
  }

 private:
  Vec3d position_;
  Vec3d x_{1, 0, 0}, y_{0, 1, 0}, z_{0, 0, 1};  // the shape's axes in the world
};

}  // namespace sessile
