#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sessile/core/vec.h"
#include "sessile/scene/solid_mesh.h"
#include "sessile/surface/surface_mesh.h"

namespace sessile::draw {

/// What stays the same from moment to moment.
struct Stage {
  double spacing = 0;       ///< particle spacing [m]
  Vec3d up{0, 0, 1};        ///< away from gravity; z without gravity
  bool weightless = false;  ///< no gravity: nothing to stand on
  Vec3d low{}, high{};      ///< box around what is worth seeing: solids and the liquid at the start [m]
  std::vector<SolidMesh> solids;
  int time_decimals = 2;  ///< with which times of the run are written
};

/// What there is to see at one time.
struct Moment {
  double time = 0;                     ///< [s]
  int time_decimals = 2;               ///< as the time is written
  std::vector<float> points;           ///< x y z of each particle [m]
  std::vector<float> values;           ///< of the field that colours, one per particle; a vector's length
  std::string field;                   ///< its name
  std::string unit;                    ///< SI
  std::optional<SurfaceMesh> surface;  ///< for Look::surface
};

/// How it is drawn.
enum class Look { particles, liquid, surface };

/// Keeps what lies on the far side of `normal` . x = offset, as seen from where the normal points to.
struct ClippingPlane {
  Vec3d normal{1, 0, 0};
  double offset = 0;  ///< [m]
};

struct Appearance {
  Look look = Look::particles;
  std::optional<std::pair<float, float>> range;  ///< ends of the colours; without it those of the moment
  std::optional<ClippingPlane> clip;
  bool legend = true;  ///< colour bar with name and unit, and the time
  bool solids = true;
  bool ground = true;  ///< a plane below, to take the shadow, where no solid lies below all
  int fineness = 1;    ///< rays a pixel along each axis: 1 for speed, with edges softened; 2 or 3 for pictures
};

}  // namespace sessile::draw
