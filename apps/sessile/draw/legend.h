#pragma once

#include <utility>

#include "draw/moment.h"

namespace sessile::draw {

/// The share of a picture's height that the colour bar takes at the bottom.
float legend_share();

/// Draws colour bar, name, unit, ends of the range and the time with Dear ImGui, within the frame that has been begun:
/// the window and headless pictures share it. `width` and `height` are those of the picture [pixels].
void draw_legend(const Moment& moment, const Appearance& appearance, std::pair<float, float> range, float width,
                 float height);

}  // namespace sessile::draw
