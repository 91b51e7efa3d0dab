#include "draw/color_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace sessile::draw {
namespace {

double to_linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

double to_stored(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

/// A stop of the map: how light, how colourful, and the hue in degrees.
struct Stop {
  double lightness, chroma, hue;
};

// Hues turn by the short way from violet-blue to yellow; chroma keeps within what screens show.
constexpr std::array<Stop, 6> stops{{{0.420, 0.150, 268},
                                     {0.523, 0.128, 248},
                                     {0.626, 0.103, 216},
                                     {0.729, 0.118, 168},
                                     {0.832, 0.155, 128},
                                     {0.935, 0.155, 106}}};

/// Between the stops by Catmull and Rom's cubic; `place` from 0 to 1.
OkLab between_stops(double place) {
  const double at = place * (stops.size() - 1);
  const int last = static_cast<int>(stops.size()) - 1;
  const int k = std::min(static_cast<int>(at), last - 1);
  const double t = at - k;
  const auto stop = [&](int i) { return stops[static_cast<std::size_t>(std::clamp(i, 0, last))]; };
  const auto cubic = [&](double Stop::*part) {
    // Beyond the ends the line goes on straight.
    const double p1 = stop(k).*part, p2 = stop(k + 1).*part;
    const double p0 = k > 0 ? stop(k - 1).*part : 2 * p1 - p2;
    const double p3 = k + 2 <= last ? stop(k + 2).*part : 2 * p2 - p1;
    return p1 + 0.5 * t * (p2 - p0 + t * (2 * p0 - 5 * p1 + 4 * p2 - p3 + t * (3 * (p1 - p2) + p3 - p0)));
  };
  const double chroma = cubic(&Stop::chroma), hue = cubic(&Stop::hue) * std::numbers::pi / 180;
  return {cubic(&Stop::lightness), chroma * std::cos(hue), chroma * std::sin(hue)};
}

double distance(const OkLab& p, const OkLab& q) { return std::hypot(p.lightness - q.lightness, p.a - q.a, p.b - q.b); }

}  // namespace

OkLab to_oklab(const Rgb& color) {
  const double r = to_linear(color[0]), g = to_linear(color[1]), b = to_linear(color[2]);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Rgb to_rgb(const OkLab& color) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(color.lightness + 0.3963377774 * color.a + 0.2158037573 * color.b);
  const double m = cube(color.lightness - 0.1055613458 * color.a - 0.0638541728 * color.b);
  const double s = cube(color.lightness - 0.0894841775 * color.a - 1.2914855480 * color.b);
  return {to_stored(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          to_stored(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          to_stored(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

std::vector<Rgb> color_map(int count) {
  // Walks along the curve and takes a colour at each equal share of its length.
  constexpr int fine = 4096;
  std::vector<double> way(fine + 1, 0.0);
  OkLab last = between_stops(0);
  for (int k = 1; k <= fine; ++k) {
    const OkLab next = between_stops(static_cast<double>(k) / fine);
    way[static_cast<std::size_t>(k)] = way[static_cast<std::size_t>(k) - 1] + distance(last, next);
    last = next;
  }
  std::vector<Rgb> colors;
  for (int k = 0; k < count; ++k) {
    const double wanted = way.back() * k / std::max(count - 1, 1);
    const auto after = std::lower_bound(way.begin(), way.end(), wanted);
    const auto place = static_cast<double>(after - way.begin()) / fine;
    Rgb color = to_rgb(between_stops(std::min(place, 1.0)));
    for (double& c : color) c = std::clamp(c, 0.0, 1.0);
    colors.push_back(color);
  }
  return colors;
}

}  // namespace sessile::draw
