#pragma once

#include <string>

#include "draw/camera.h"
#include "draw/moment.h"
#include "sessile/scene/surface_settings.h"

namespace sessile::viewer {

/// How things are shown, as the panel and the keys set it.
struct Settings {
  draw::Camera camera;
  draw::Appearance appearance;
  std::string field = "speed";
  bool fixed_range = false;
  float low = 0, high = 1;  ///< ends of a fixed range
  bool clipped = false;
  draw::ClippingPlane plane;
  SurfaceSettings surface;
  bool panel = true, help = false;
};

}  // namespace sessile::viewer
