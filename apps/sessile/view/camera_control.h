#pragma once

#include "draw/camera.h"
#include "sessile/core/vec.h"

namespace sessile::viewer {

/// Turns, moves and zooms the camera as the mouse does over the picture; `height` is that of the picture [pixels].
/// Reads ImGui's mouse; returns whether anything changed.
bool follow_mouse(draw::Camera& camera, float height);

/// Looks along an axis: from its positive side, or from the other one when it looks so already.
void look_along(draw::Camera& camera, const Vec3d& axis);

}  // namespace sessile::viewer
