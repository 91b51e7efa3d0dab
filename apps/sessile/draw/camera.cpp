#include "draw/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sessile::draw {
namespace {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180; }

Vec3d unit(const Vec3d& a) { return 1 / length(a) * a; }

/// What part of the picture's half height and half width the box may fill.
constexpr double filled = 0.94;

/// Of a box's corners in the camera's axes: where between them the eye's axis should pass, and how far away from the
/// origin of z the eye must be for all of them to be seen. `low` and `high` are the slopes of the picture's edges.
struct Span {
  double low, high;
  bool orthographic;
  double least = 1e300, greatest = -1e300;

  void add(double across, double towards) {
    const double z = orthographic ? 0 : towards;
    least = std::min(least, across - low * z);
    greatest = std::max(greatest, across + high * z);
  }
  double distance() const { return (greatest - least) / (low + high); }
  /// Of an eye at that distance, or further away: the middle of where it may be.
  double place(double eye) const { return 0.5 * (greatest - high * eye + least + low * eye); }
};

}  // namespace

Vec3d Camera::eye() const { return target - distance * forward(); }

Vec3d Camera::right() const { return unit(cross(forward(), up)); }

Vec3d Camera::upward() const { return cross(right(), forward()); }

Vec3d Camera::forward() const {
  const Vec3d above = unit(up);
  const Vec3d side = unit(cross(std::abs(above.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}, above));
  const Vec3d front = cross(above, side);
  const double a = radians(azimuth), e = radians(elevation);
  return std::cos(e) * (std::cos(a) * front - std::sin(a) * side) - std::sin(e) * above;
}

void Camera::orbit(double azimuth_by, double elevation_by) {
  azimuth = std::remainder(azimuth + azimuth_by, 360);
  elevation = std::clamp(elevation + elevation_by, -89.9, 89.9);
}

void Camera::pan(double right_by, double up_by) {
  const double height = 2 * distance * std::tan(0.5 * radians(field_of_view));
  target -= height * (right_by * right() + up_by * upward());
}

void Camera::zoom(double factor) { distance /= factor; }

void Camera::fit(const Vec3d& low, const Vec3d& high, double aspect, double kept_below) {
  const Vec3d r = right(), u = upward(), back = -forward(), centre = 0.5 * (low + high);
  const double slope = filled * std::tan(0.5 * radians(field_of_view));
  Span across{slope * aspect, slope * aspect, orthographic};
  Span along{slope * (1 - 2 * kept_below), slope, orthographic};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p = Vec3d{(corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                          (corner & 4) != 0 ? high.z : low.z} -
                    centre;
    across.add(dot(p, r), dot(p, back));
    along.add(dot(p, u), dot(p, back));
  }
  const double away = std::max(across.distance(), along.distance());
  if (!(away > 0)) {  // a point: any distance shows it
    target = centre;
    return;
  }
  target = centre + across.place(away) * r + along.place(away) * u;
  distance = away;
}

Matrix Camera::view() const {
  const Vec3<float> r = vec_cast<float>(right()), u = vec_cast<float>(upward()), b = vec_cast<float>(-forward());
  const Vec3d e = eye();
  const auto along = [&](const Vec3d& axis) { return static_cast<float>(-dot(axis, e)); };
  return {r.x, u.x, b.x, 0, r.y, u.y, b.y, 0, r.z, u.z, b.z, 0, along(right()), along(upward()), along(-forward()), 1};
}

Matrix Camera::projection(double aspect, double radius) const {
  const double slope = std::tan(0.5 * radians(field_of_view));
  const double far = distance + radius;
  const auto number = [](double x) { return static_cast<float>(x); };
  if (orthographic) {
    const double near = distance - radius, half = distance * slope;
    return {number(1 / (half * aspect)),
            0,
            0,
            0,
            0,
            number(1 / half),
            0,
            0,
            0,
            0,
            number(-2 / (far - near)),
            0,
            0,
            0,
            number(-(far + near) / (far - near)),
            1};
  }
  const double near = std::max(distance - radius, 1e-3 * far);
  return {number(1 / (slope * aspect)),
          0,
          0,
          0,
          0,
          number(1 / slope),
          0,
          0,
          0,
          0,
          number(-(far + near) / (far - near)),
          -1,
          0,
          0,
          number(-2 * far * near / (far - near)),
          0};
}

}  // namespace sessile::draw
