#include <cmath>
#include <numbers>

#include "sessile/scene/frame.h"
#include "sessile/scene/shapes.h"

namespace sessile {

namespace {

/// Sine and cosine of an angle [deg], exact at quarter turns: lattices must stay lattices.
void sine_cosine(double degrees, double& sine, double& cosine) {
  const double angle = std::remainder(degrees, 360);
  if (std::remainder(angle, 90) == 0) {
    const int quarter = static_cast<int>(std::lround(angle / 90));
    sine = quarter == 1 ? 1 : quarter == -1 ? -1 : 0;
    cosine = quarter == 0 ? 1 : quarter == 1 || quarter == -1 ? 0 : -1;
    return;
  }
  sine = std::sin(angle * std::numbers::pi / 180);
  cosine = std::cos(angle * std::numbers::pi / 180);
}

}  // namespace

Frame::Frame(const Placement& placement) : position_(placement.position) {
  double s = 0, c = 1;
  sine_cosine(placement.angle, s, c);
  const double length = std::hypot(placement.axis.x, placement.axis.y, placement.axis.z);
  if ((s == 0 && c == 1) || length == 0) return;
  // A subnormal axis would lose its direction when squared, so it is divided first.
  const Vec3d u{placement.axis.x / length, placement.axis.y / length, placement.axis.z / length};
  const double k = 1 - c;
  x_ = {c + k * u.x * u.x, k * u.x * u.y + s * u.z, k * u.x * u.z - s * u.y};
  y_ = {k * u.x * u.y - s * u.z, c + k * u.y * u.y, k * u.y * u.z + s * u.x};
  z_ = {k * u.x * u.z + s * u.y, k * u.y * u.z - s * u.x, c + k * u.z * u.z};
}

Vec3d Placement::to_world(const Vec3d& local) const { return Frame(*this).to_world(local); }
Vec3d Placement::to_local(const Vec3d& world) const { return Frame(*this).to_local(world); }
Vec3d Placement::turn(const Vec3d& direction) const { return Frame(*this).turn(direction); }

}  // namespace sessile
