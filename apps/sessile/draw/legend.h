#pragma once

#include <utility>

#include "draw/moment.h"

namespace sessile::draw {

/// The share of a picture's height that the colour bar takes at the bottom.
float legend_share();

/// The time, at the top of a picture of that height whose left edge is at `left` [pixels].
void draw_time(const Moment& moment, float left, float height);

/// The colour bar with name, unit and numbers, at the bottom of a picture of that size [pixels]; nothing where nothing
/// is coloured.
void draw_color_bar(const Moment& moment, const Appearance& appearance, std::pair<float, float> range, float width,
                    float height);

/// Both, where the appearance wants a legend, with Dear ImGui within the frame that has been begun: the window and
/// headless pictures share it. `width` and `height` are those of the picture [pixels].
void draw_legend(const Moment& moment, const Appearance& appearance, std::pair<float, float> range, float width,
                 float height);

}  // namespace sessile::draw
