#include "view/camera_control.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sessile::viewer {
namespace {

constexpr double degrees_per_height = 180;  // of turning, for a drag over the picture's height
constexpr double zoom_per_notch = 1.15, zoom_per_height = 8;

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

}  // namespace

bool follow_mouse(draw::Camera& camera, float height) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantCaptureMouse) return false;
  bool changed = false;
  if (io.MouseWheel != 0) {
    camera.zoom(std::pow(zoom_per_notch, static_cast<double>(io.MouseWheel)));
    changed = true;
  }
  const double across = static_cast<double>(io.MouseDelta.x / height),
               down = static_cast<double>(io.MouseDelta.y / height);
  if (across == 0 && down == 0) return changed;
  const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) || (left && io.KeyShift)) {
    camera.pan(across, -down);
    return true;
  }
  if (left) {
    camera.orbit(-degrees_per_height * across, degrees_per_height * down);
    return true;
  }
  if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
    camera.zoom(std::pow(zoom_per_height, -down));
    return true;
  }
  return changed;
}

void look_along(draw::Camera& camera, const Vec3d& axis) {
  const auto look = [&](const Vec3d& from) {
    const Vec3d up = (1 / length(camera.up)) * camera.up;
    camera.elevation = 0;
    camera.azimuth = 0;
    const Vec3d at_0 = -camera.forward();
    camera.azimuth = 90;
    const Vec3d at_90 = -camera.forward();
    camera.azimuth = degrees(std::atan2(dot(from, at_90), dot(from, at_0)));
    camera.elevation = std::clamp(degrees(std::asin(std::clamp(dot(from, up), -1.0, 1.0))), -89.9, 89.9);
  };
  const bool already = dot(-camera.forward(), axis) > 0.9999;
  look(already ? -axis : axis);
}

}  // namespace sessile::viewer
