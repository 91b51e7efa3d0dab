#include <algorithm>
#include <cmath>
#include <exception>

#include "draw/legend.h"
#include "view/camera_control.h"
#include "view/viewer.h"

namespace sessile::viewer {

void Viewer::act(Action action) {
  restless_ = 3;
  switch (action) {
    case Action::play:
    case Action::forward:
    case Action::backward:
    case Action::reset:
      source_.act(action);
      break;
    case Action::still:
      try {
        paint(true);
        say(capture_.save(canvas_.image(), canvas_.moment().time));
      } catch (const std::exception& e) {
        say(e.what());
      }
      break;
    case Action::video:
      toggle_video();
      break;
    case Action::panel:
      settings_.panel = !settings_.panel;
      break;
    case Action::help:
      settings_.help = !settings_.help;
      break;
    case Action::quit:
      if (settings_.help) {
        settings_.help = false;
      } else {
        window_.close();
      }
      break;
    default:
      dirty_ = true;
      act_on_view(action);
  }
}

void Viewer::act_on_view(Action action) {
  switch (action) {
    case Action::fit:
      fit(true);
      break;
    case Action::particles:
      set_look(draw::Look::particles);
      break;
    case Action::liquid:
      set_look(draw::Look::liquid);
      break;
    case Action::surface:
      set_look(draw::Look::surface);
      break;
    case Action::along_x:
      look_along(settings_.camera, {1, 0, 0});
      break;
    case Action::along_y:
      look_along(settings_.camera, {0, 1, 0});
      break;
    case Action::along_z:
      look_along(settings_.camera, {0, 0, 1});
      break;
    case Action::orthographic:
      settings_.camera.orthographic = !settings_.camera.orthographic;
      break;
    case Action::clip:
      toggle_clip();
      break;
    case Action::legend:
      settings_.appearance.legend = !settings_.appearance.legend;
      break;
    default:
      break;
  }
}

void Viewer::set_look(draw::Look look) {
  settings_.appearance.look = look;
  if (look == draw::Look::surface) {
    source_.want_surface(settings_.surface);
  } else {
    source_.want_surface({});
  }
}

/// Cuts through the middle, square to the axis that points most towards the eye.
void Viewer::toggle_clip() {
  settings_.clipped = !settings_.clipped;
  if (!settings_.clipped) return;
  const Vec3d out = -settings_.camera.forward();
  const Vec3d size{std::abs(out.x), std::abs(out.y), std::abs(out.z)};
  Vec3d& normal = settings_.plane.normal;
  normal = size.x >= size.y && size.x >= size.z ? Vec3d{std::copysign(1.0, out.x), 0, 0}
           : size.y >= size.z                   ? Vec3d{0, std::copysign(1.0, out.y), 0}
                                                : Vec3d{0, 0, std::copysign(1.0, out.z)};
  Vec3d low = stage_.low, high = stage_.high;
  canvas_.bounds(low, high);
  settings_.plane.offset = dot(normal, 0.5 * (low + high));
}

void Viewer::toggle_video() {
  try {
    if (capture_.recording()) {
      if (!source_.video_by_moment()) capture_.add(canvas_.image(), false);  // up to now
      say(capture_.finish());
    } else {
      paint(true);
      say(capture_.start(canvas_.width(), canvas_.height(), canvas_.moment().time));
      capture_.add(canvas_.image(), true);  // it begins with what is shown
      fresh_ = false;
    }
  } catch (const std::exception& e) {
    say(e.what());
  }
}

/// Fits the stage into the picture, or the liquid alone.
void Viewer::fit(bool liquid) {
  Vec3d low = stage_.low, high = stage_.high;
  if (liquid && canvas_.bounds(low, high)) {
    const Vec3d margin = Vec3d{1, 1, 1} * stage_.spacing;
    low = low - margin;
    high = high + margin;
  }
  const Region region = picture();
  const double aspect = static_cast<double>(region.width) / region.height;
  const double legend = settings_.appearance.legend ? static_cast<double>(draw::legend_share()) : 0;
  settings_.camera.fit(low, high, aspect, legend);
}

}  // namespace sessile::viewer
