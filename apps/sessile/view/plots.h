#pragma once

#include <optional>

#include "view/history.h"

namespace sessile::viewer {

/// Draws one quantity over time with axes, as wide as there is room, within ImGui's current window. `height` in units
/// of the interface's font; `now` marks a time [s].
void draw_plot(const History& history, std::size_t series, float height, std::optional<double> now);

/// Distance of axis marks: 1, 2 or 5 times a power of ten, at most `most` of them over a length.
double mark_distance(double length, int most);

}  // namespace sessile::viewer
