#include "sessile/surface/cloud.h"

#include <fmt/format.h>

#include <cmath>

#include "sessile/core/error.h"
#include "sessile/core/parallel.h"

namespace sessile {

Cloud::Cloud(std::span<const float> points, double spacing, double search_over_radius) {
  unit = std::exp2(std::round(std::log2(spacing / 2)));
  radius = spacing / 2 / unit;
  search_radius = search_over_radius * radius;
  const std::size_t n = points.size() / 3;
  Array3 unsorted;
  unsorted.resize(n);
  const double per_unit = 1 / unit;
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = [&](std::size_t k) { return static_cast<Real>(points[3 * i + k] * per_unit); };
    unsorted.set(i, {at(0), at(1), at(2)});
    if (!std::isfinite(squared_length(vec_cast<double>(unsorted[i])))) {
      throw Error(fmt::format("no surface: particle {} of the frame is at no finite place", i));
    }
  }
  grid.build(unsorted, GridShape::make(search_radius, {}, {}));
  position.resize(n);
  for_each(n, [&](int i) {
    const auto to = static_cast<std::size_t>(i);
    position.set(to, unsorted[static_cast<std::size_t>(grid.order()[to])]);
  });
  near.build({position, grid}, {position, grid}, Space{}, static_cast<Real>(search_radius));
}

}  // namespace sessile
