#include "sessile/surface/cloud.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sessile/core/error.h"
#include "sessile/core/memory_limit.h"
#include "sessile/core/parallel.h"

namespace sessile {
namespace {

/// Lists of neighbours grow with the square of those that crowd together. A run ends at 30 times the rest density; this
/// is 512 times. What fills all cells like that is held against the memory.
void refuse_crowd(const Grid& grid, double spacing, double search_over_radius) {
  const double cell = search_over_radius / 2;  // [spacings]
  const auto most = static_cast<std::size_t>(std::max(4096.0, 512 * cell * cell * cell));
  if (const std::size_t held = grid.fullest_cell(); held > most) {
    throw Error(
        fmt::format("no surface: {} particles of the frame crowd into one cube with an edge of {:.3g} m, where "
                    "{} are the most: the liquid has collapsed there, or the spacing is not that of the frame",
                    held, cell * spacing, most));
  }
  double entries = 0;
  Grid::Cursor cursor;
  std::array<PlaceRange, 18> ranges;
  for (std::size_t k = 0; k < grid.cell_count(); ++k) {
    const PlaceRange own = grid.places(k);
    const int found = grid.around(grid.cell(k), cursor, ranges);
    double around = 0;
    for (int r = 0; r < found; ++r)
      around += ranges[static_cast<std::size_t>(r)].end - ranges[static_cast<std::size_t>(r)].begin;
    // Of those in the 27 cells a sixth is near enough where they are spread evenly; where they crowd, all may be.
    const double crowded = 30 * 27 * std::max(1.0, cell * cell * cell);
    entries += (own.end - own.begin) * (around > crowded ? around : around / 4);
  }
  const MemoryLimit memory = memory_limit();
  if (const double needed = entries * sizeof(std::int32_t); needed > memory.bytes / 2) {
    throw Error(
        fmt::format("no surface: the frame's particles have about {:.3g} neighbours in all, which take {:.3g} "
                    "GiB; {} {:.3g} GiB, and half of it may go there",
                    entries, needed / (1 << 30), memory.what, memory.bytes / (1 << 30)));
  }
}

}  // namespace

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
      const bool told =
          std::isfinite(points[3 * i]) && std::isfinite(points[3 * i + 1]) && std::isfinite(points[3 * i + 2]);
      throw Error(fmt::format("no surface: particle {} of the frame is at no finite place{}", i,
                              told ? " once it is measured in spacings: it is too far away" : ""));
    }
  }
  grid.build(unsorted, GridShape::make(search_radius, {}, {}));
  position.resize(n);
  for_each(n, [&](int i) {
    const auto to = static_cast<std::size_t>(i);
    position.set(to, unsorted[static_cast<std::size_t>(grid.order()[to])]);
  });
  refuse_crowd(grid, spacing, search_over_radius);
  near.build({position, grid}, {position, grid}, Space{}, static_cast<Real>(search_radius));
}

}  // namespace sessile
