#pragma once

#include <array>

#include "sessile/core/vec.h"

namespace sessile::draw {

/// 4 x 4 numbers, column by column, as OpenGL reads them.
using Matrix = std::array<float, 16>;

/// Where the picture is taken from: a place on a sphere around the point looked at.
struct Camera {
  Vec3d target{};             ///< what stands in the middle [m]
  Vec3d up{0, 0, 1};          ///< away from gravity
  double distance = 1;        ///< from the eye to the target [m]
  double azimuth = 30;        ///< about `up` [deg]
  double elevation = 25;      ///< above the horizontal [deg]
  double field_of_view = 35;  ///< vertical [deg]
  bool orthographic = false;

  Vec3d eye() const;  ///< [m]
  Vec3d right() const;
  Vec3d upward() const;   ///< of the picture
  Vec3d forward() const;  ///< from the eye to the target

  void orbit(double azimuth_by, double elevation_by);  ///< [deg]; elevation stays within +-89.9
  void pan(double right_by, double up_by);             ///< moves what is seen; in shares of the picture's height
  void zoom(double factor);                            ///< distance divided by it

  /// Puts the box, with a margin, into a picture of that width over height, as large as it goes; keeps the direction.
  /// `kept_below` is the share of the height that stays free at the bottom, for a legend.
  void fit(const Vec3d& low, const Vec3d& high, double aspect, double kept_below = 0);

  Matrix view() const;
  /// Near and far planes enclose a ball around the target of that radius [m].
  Matrix projection(double aspect, double radius) const;
};

}  // namespace sessile::draw
