#pragma once

#include <array>
#include <vector>

namespace sessile::draw {

/// A colour in OKLab (B. Ottosson 2020): equal distances look about equally large.
struct OkLab {
  double lightness, a, b;
};

using Rgb = std::array<double, 3>;  ///< sRGB as stored, 0 to 1

OkLab to_oklab(const Rgb& color);
Rgb to_rgb(const OkLab& color);  ///< not clamped: a component outside 0 to 1 cannot be shown

/// `count` colours from dark blue by green to light yellow, in steps that look equally large, each lighter than the
/// last.
std::vector<Rgb> color_map(int count);

}  // namespace sessile::draw
