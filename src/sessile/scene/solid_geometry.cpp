#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "sessile/scene/frame.h"
#include "sessile/scene/mesh_space.h"
#include "sessile/scene/sampling.h"

namespace sessile {

namespace {

/// The part [t0, t1] of the way a + t (b - a) that lies strictly between -half and half along one axis.
bool clip(double a, double b, double half, double& t0, double& t1) {
  if (a == b) return std::abs(a) < half;
  const double enter = (std::copysign(half, a - b) - a) / (b - a);
  const double leave = (std::copysign(half, b - a) - a) / (b - a);
  t0 = std::max(t0, enter);
  t1 = std::min(t1, leave);
  return t0 < t1;
}

/// The part of the way inside an upright circle, by the roots of |a + t d|^2 = r^2.
bool clip_circle(double square_d, double a_d, double square_a, double radius, double& t0, double& t1) {
  const double c = square_a - radius * radius;
  if (square_d == 0) return c < 0;
  const double radicand = a_d * a_d - square_d * c;
  if (!(radicand > 0)) return false;
  const double root = std::sqrt(radicand);
  t0 = std::max(t0, (-a_d - root) / square_d);
  t1 = std::min(t1, (-a_d + root) / square_d);
  return t0 < t1;
}

struct BoxSpace {
  Vec3d half;
  bool contains(const Vec3d& p) const {
    return std::abs(p.x) < half.x && std::abs(p.y) < half.y && std::abs(p.z) < half.z;
  }
  bool crossed(const Vec3d& a, const Vec3d& b) const {
    double t0 = 0, t1 = 1;
    return !contains(a) && clip(a.x, b.x, half.x, t0, t1) && clip(a.y, b.y, half.y, t0, t1) &&
           clip(a.z, b.z, half.z, t0, t1);
  }
};

/// The outside of a box.
struct HollowSpace {
  Vec3d half;
  bool contains(const Vec3d& p) const {
    return std::abs(p.x) > half.x || std::abs(p.y) > half.y || std::abs(p.z) > half.z;
  }
  bool crossed(const Vec3d& a, const Vec3d& b) const { return !contains(a) && contains(b); }  // the hollow is convex
};

struct PlateSpace {
  Vec3d half;
  bool contains(const Vec3d&) const { return false; }
  bool crossed(const Vec3d& a, const Vec3d& b) const {
    if ((a.z >= 0) == (b.z >= 0)) return false;
    const Vec3d hit = a + a.z / (a.z - b.z) * (b - a);
    return std::abs(hit.x) <= half.x && std::abs(hit.y) <= half.y;
  }
};

struct BallSpace {
  double radius;
  bool contains(const Vec3d& p) const { return squared_length(p) < radius * radius; }
  bool crossed(const Vec3d& a, const Vec3d& b) const {
    double t0 = 0, t1 = 1;
    const Vec3d d = b - a;
    return !contains(a) && clip_circle(squared_length(d), dot(a, d), squared_length(a), radius, t0, t1);
  }
};

struct CylinderSpace {
  double radius, half;
  bool contains(const Vec3d& p) const { return p.x * p.x + p.y * p.y < radius * radius && std::abs(p.z) < half; }
  bool crossed(const Vec3d& a, const Vec3d& b) const {
    double t0 = 0, t1 = 1;
    const Vec3d p{a.x, a.y, 0}, d{b.x - a.x, b.y - a.y, 0};
    return !contains(a) && clip(a.z, b.z, half, t0, t1) &&
           clip_circle(squared_length(d), dot(p, d), squared_length(p), radius, t0, t1);
  }
};

/// A mesh; one that is not closed has no inside, and is crossed from both sides.
struct SurfaceSpace {
  MeshSpace space;
  bool closed;
  bool contains(const Vec3d& p) const { return closed && space.contains(p); }
  bool crossed(const Vec3d& a, const Vec3d& b) const { return space.crossed(a, b) && !contains(a); }
};

using SolidSpace = std::variant<BoxSpace, HollowSpace, PlateSpace, BallSpace, CylinderSpace, SurfaceSpace>;

struct Extent {
  Vec3d low, high;
};

Extent centred(const Vec3d& half) { return {-half, half}; }

}  // namespace

struct SolidGeometry::Impl {
  explicit Impl(const Solid& solid) : frame(solid.placement), space(make(solid.shape)) {
    const double most = std::numeric_limits<double>::max();
    world = {{most, most, most}, {-most, -most, -most}};
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto pick = [&](unsigned bit, double low, double high) { return (corner & bit) != 0U ? high : low; };
      const Vec3d p = frame.to_world(
          {pick(1, local.low.x, local.high.x), pick(2, local.low.y, local.high.y), pick(4, local.low.z, local.high.z)});
      world.low = {std::min(world.low.x, p.x), std::min(world.low.y, p.y), std::min(world.low.z, p.z)};
      world.high = {std::max(world.high.x, p.x), std::max(world.high.y, p.y), std::max(world.high.z, p.z)};
    }
  }

  SolidSpace make(const SolidShape& shape) {
    return std::visit([&](const auto& chosen) { return make_space(chosen); }, shape);
  }
  SolidSpace make_space(const Box& box) {
    local = centred(0.5 * box.size);
    return BoxSpace{local.high};
  }
  SolidSpace make_space(const Container& container) {
    local = centred(0.5 * container.size);
    return HollowSpace{local.high};
  }
  SolidSpace make_space(const Plate& plate) {
    local = centred({plate.width / 2, plate.depth / 2, 0});
    return PlateSpace{local.high};
  }
  SolidSpace make_space(const Sphere& sphere) {
    local = centred({sphere.radius, sphere.radius, sphere.radius});
    return BallSpace{sphere.radius};
  }
  SolidSpace make_space(const Cylinder& cylinder) {
    local = centred({cylinder.radius, cylinder.radius, cylinder.height / 2});
    return CylinderSpace{cylinder.radius, cylinder.height / 2};
  }
  SolidSpace make_space(const Mesh& file) {
    const TriangleMesh mesh = load_mesh(file);
    local = {mesh.lower(), mesh.upper()};
    return SurfaceSpace{MeshSpace(mesh), mesh.closed()};
  }

  Extent local{};  // filled by make(), so it stands before space
  Extent world{};
  Frame frame;
  SolidSpace space;
};

SolidGeometry::SolidGeometry(const Solid& solid) : impl_(std::make_unique<Impl>(solid)) {}
SolidGeometry::~SolidGeometry() = default;
SolidGeometry::SolidGeometry(SolidGeometry&&) noexcept = default;
SolidGeometry& SolidGeometry::operator=(SolidGeometry&&) noexcept = default;

bool SolidGeometry::contains(const Vec3d& point) const {
  const Vec3d p = impl_->frame.to_local(point);
  return std::visit([&](const auto& space) { return space.contains(p); }, impl_->space);
}

bool SolidGeometry::crossed(const Vec3d& a, const Vec3d& b) const {
  const Vec3d p = impl_->frame.to_local(a), q = impl_->frame.to_local(b);
  return std::visit([&](const auto& space) { return space.crossed(p, q); }, impl_->space);
}

Vec3d SolidGeometry::lower() const { return impl_->world.low; }
Vec3d SolidGeometry::upper() const { return impl_->world.high; }

}  // namespace sessile
