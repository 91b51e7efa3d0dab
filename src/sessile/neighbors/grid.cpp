#include "sessile/neighbors/grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "sessile/core/error.h"
#include "sessile/core/parallel.h"
#include "sessile/core/radix_sort.h"

namespace sessile {
namespace {

// A cell is this much longer than the support radius: pairs closer than it in float arithmetic then never lie two
// cells apart, whatever the rounding of their cells' numbers.
constexpr double cell_margin = 1 + 1e-6;

int bits_for(std::int64_t count) { return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(count) + 1)); }

}  // namespace

GridShape GridShape::make(double support_radius, const Vec3d& origin, const Vec3d& period) {
  const auto axis = [&](double start, double length) {
    GridAxis made{start, support_radius * cell_margin, 0, 0};
    if (length > 0) {
      made.ring = std::max<std::int64_t>(1, static_cast<std::int64_t>(length / made.cell));
      made.cell = length / static_cast<double>(made.ring);
    }
    made.inverse_cell = 1 / made.cell;
    return made;
  };
  return {{axis(origin.x, period.x), axis(origin.y, period.y), axis(origin.z, period.z)}};
}

std::int64_t Grid::AxisNumbers::number_at_or_after(std::int64_t cell) const {
  if (occupied.empty()) return std::clamp(cell - first + 1, std::int64_t{1}, count + 1);
  const auto found = std::lower_bound(occupied.begin(), occupied.end(), cell);
  return found == occupied.end() ? count + 1 : numbers[static_cast<std::size_t>(found - occupied.begin())];
}

std::int64_t Grid::AxisNumbers::number_at_or_before(std::int64_t cell) const {
  if (occupied.empty()) return std::clamp(cell - first + 1, std::int64_t{0}, count);
  const auto found = std::upper_bound(occupied.begin(), occupied.end(), cell);
  return found == occupied.begin() ? 0 : numbers[static_cast<std::size_t>(found - occupied.begin()) - 1];
}

std::int64_t Grid::AxisNumbers::cell(std::int64_t number) const {
  if (occupied.empty()) return first + number - 1;
  return occupied[static_cast<std::size_t>(std::lower_bound(numbers.begin(), numbers.end(), number) - numbers.begin())];
}

void Grid::AxisNumbers::close_gaps(std::vector<std::int64_t> cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  occupied = std::move(cells);
  numbers.resize(occupied.size());
  count = 0;
  for (std::size_t k = 0; k < occupied.size(); ++k) {
    count += k > 0 && occupied[k] - occupied[k - 1] > 1 ? 2 : 1;
    numbers[k] = count;
  }
  bits = bits_for(count);
}

void Grid::number_axes(const Array3& points) {
  // A cell never comes before that of a point further down, so the outermost points lie in the outermost cells.
  struct Bounds {
    Vec3r low, high;
  };
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  const Bounds bounds = reduce(
      points.size(), Bounds{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}},
      [&](int i) {
        const Vec3r x = points[static_cast<std::size_t>(i)];
        return Bounds{x, x};
      },
      [](const Bounds& a, const Bounds& b) {
        using std::min, std::max;
        return Bounds{{min(a.low.x, b.low.x), min(a.low.y, b.low.y), min(a.low.z, b.low.z)},
                      {max(a.high.x, b.high.x), max(a.high.y, b.high.y), max(a.high.z, b.high.z)}};
      });
  const auto low = shape_.cell_of(bounds.low), high = shape_.cell_of(bounds.high);
  const auto total_bits = [&] { return axes_[0].bits + axes_[1].bits + axes_[2].bits; };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t ring = shape_.axes[k].ring;
    axes_[k] = {};
    axes_[k].first = ring > 0 ? 0 : low[k];
    axes_[k].count = ring > 0 ? ring : high[k] - low[k] + 1;
    axes_[k].bits = bits_for(axes_[k].count);
  }
  if (total_bits() < 64) return;
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<std::int64_t> cells(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) cells[i] = shape_.cell_of(points[i])[k];
    axes_[k].close_gaps(std::move(cells));
  }
  if (total_bits() >= 64) throw RunError("the particles are scattered too far and wide to sort them into cells");
}

std::uint64_t Grid::key(std::int64_t x, std::int64_t y, std::int64_t z) const {
  return ((static_cast<std::uint64_t>(z) << axes_[1].bits | static_cast<std::uint64_t>(y)) << axes_[0].bits) |
         static_cast<std::uint64_t>(x);
}

void Grid::build(const Array3& points, const GridShape& shape) {
  shape_ = shape;
  keys_.clear();
  begins_.assign(1, 0);
  order_.resize(points.size());
  if (points.size() == 0) return;
  number_axes(points);

  items_.resize(points.size());
  for_each(points.size(), [&](int i) {
    const auto place = static_cast<std::size_t>(i);
    const auto cell = shape_.cell_of(points[place]);
    items_[place] = {key(axes_[0].number(cell[0]), axes_[1].number(cell[1]), axes_[2].number(cell[2])), i};
  });
  radix_sort(items_, items_scratch_, axes_[0].bits + axes_[1].bits + axes_[2].bits);

  // Cells start where the key changes: count them block by block, then write each block's at its own place.
  const std::size_t n = items_.size();
  const auto starts_cell = [&](std::size_t k) { return k == 0 || items_[k].key != items_[k - 1].key; };
  std::vector<std::size_t> first_cell(static_cast<std::size_t>(block_count(n)) + 1, 0);
  for_each_block(n, [&](std::ptrdiff_t block, std::ptrdiff_t begin, std::ptrdiff_t end) {
    std::size_t cells = 0;
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) cells += starts_cell(k);
    first_cell[static_cast<std::size_t>(block) + 1] = cells;
  });
  for (std::size_t b = 1; b < first_cell.size(); ++b) first_cell[b] += first_cell[b - 1];
  keys_.resize(first_cell.back());
  begins_.resize(first_cell.back() + 1);
  begins_.back() = static_cast<std::int32_t>(n);
  for_each_block(n, [&](std::ptrdiff_t block, std::ptrdiff_t begin, std::ptrdiff_t end) {
    std::size_t cell = first_cell[static_cast<std::size_t>(block)];
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      order_[k] = items_[k].place;
      if (!starts_cell(k)) continue;
      keys_[cell] = items_[k].key;
      begins_[cell] = static_cast<std::int32_t>(k);
      ++cell;
    }
  });
}

std::size_t Grid::cell_at(std::int32_t place) const {
  return static_cast<std::size_t>(std::upper_bound(begins_.begin(), begins_.end(), place) - begins_.begin()) - 1;
}

std::array<std::int64_t, 3> Grid::cell(std::size_t k) const {
  const auto number = [](std::uint64_t bits, const AxisNumbers& axis) {
    return axis.cell(static_cast<std::int64_t>(bits & ((std::uint64_t{1} << axis.bits) - 1)));
  };
  const std::uint64_t key = keys_[k];
  return {number(key, axes_[0]), number(key >> axes_[0].bits, axes_[1]),
          number(key >> (axes_[0].bits + axes_[1].bits), axes_[2])};
}

std::size_t Grid::seek(std::uint64_t key, std::size_t hint) const {
  // Gallop from the hint: successive searches in a row of cells are a few places apart.
  const auto at = [&](std::size_t place) { return keys_.begin() + static_cast<std::ptrdiff_t>(place); };
  std::size_t low = std::min(hint, keys_.size()), high = low, stride = 1;
  while (high < keys_.size() && keys_[high] < key) {
    low = high + 1;
    high = std::min(keys_.size(), high + stride);
    stride *= 2;
  }
  stride = 1;
  while (low > 0 && low <= keys_.size() && keys_[low - 1] >= key) {
    high = low - 1;
    low -= std::min(low, stride);
    stride *= 2;
  }
  return static_cast<std::size_t>(std::lower_bound(at(low), at(high), key) - keys_.begin());
}

void Grid::find_rows(const std::array<std::int64_t, 3>& cell, Cursor& cursor) const {
  // A ring of one or two cells holds each neighbouring cell once, not three times.
  const auto seen_before = [](std::int64_t ring, int offset) {
    return (ring == 1 && offset != 0) || (ring == 2 && offset == 1);
  };
  for (int k = 0; k < 9; ++k) {
    Cursor::Row& row = cursor.rows[static_cast<std::size_t>(k)];
    row.end = row.begin;
    const int dy = k % 3 - 1, dz = k / 3 - 1;
    if (seen_before(shape_.axes[1].ring, dy) || seen_before(shape_.axes[2].ring, dz)) continue;
    const std::int64_t y = shape_.axes[1].wrap(cell[1] + dy), z = shape_.axes[2].wrap(cell[2] + dz);
    const std::int64_t ny = axes_[1].number_at_or_after(y), nz = axes_[2].number_at_or_after(z);
    if (ny != axes_[1].number_at_or_before(y) || nz != axes_[2].number_at_or_before(z)) continue;
    row.begin = seek(key(0, ny, nz), row.begin);
    row.end = seek(key(axes_[0].count + 1, ny, nz), row.begin);
    row.at = row.begin;
  }
  cursor.row_of = {cell[1], cell[2]};
  cursor.fresh = false;
}

int Grid::around(const std::array<std::int64_t, 3>& cell, Cursor& cursor, std::span<PlaceRange, 18> ranges) const {
  if (keys_.empty()) return 0;
  if (cursor.fresh || cursor.row_of[0] != cell[1] || cursor.row_of[1] != cell[2]) find_rows(cell, cursor);
  // Stretches of cells along x: one, or two where a periodic face cuts the row.
  const std::int64_t ring = shape_.axes[0].ring;
  std::array<std::array<std::int64_t, 2>, 2> stretches{{{cell[0] - 1, cell[0] + 1}, {0, -1}}};
  int stretch_count = 1;
  if (ring > 0 && ring <= 3) {
    stretches[0] = {0, ring - 1};
  } else if (ring > 0 && cell[0] == 0) {
    stretches = {{{0, 1}, {ring - 1, ring - 1}}};
    stretch_count = 2;
  } else if (ring > 0 && cell[0] == ring - 1) {
    stretches = {{{cell[0] - 1, cell[0]}, {0, 0}}};
    stretch_count = 2;
  }
  int found = 0;
  const std::uint64_t along_x = (std::uint64_t{1} << axes_[0].bits) - 1;
  for (int s = 0; s < stretch_count; ++s) {
    const auto& stretch = stretches[static_cast<std::size_t>(s)];
    const auto low = static_cast<std::uint64_t>(axes_[0].number_at_or_after(stretch[0]));
    const auto high = static_cast<std::uint64_t>(axes_[0].number_at_or_before(stretch[1]));
    if (low > high) continue;
    for (Cursor::Row& row : cursor.rows) {
      if (row.begin == row.end) continue;
      const auto x = [&](std::size_t k) { return keys_[k] & along_x; };
      if (row.at > row.begin && x(row.at - 1) >= low) row.at = row.begin;
      // Asked in the grid's order, the next cells are a place or two on.
      for (int step = 0; step < 4 && row.at < row.end && x(row.at) < low; ++step) ++row.at;
      if (row.at < row.end && x(row.at) < low) row.at = seek((keys_[row.at] & ~along_x) | low, row.at);
      std::size_t end = row.at;
      while (end < row.end && x(end) <= high) ++end;
      if (row.at < end) ranges[static_cast<std::size_t>(found++)] = {begins_[row.at], begins_[end]};
    }
  }
  return found;
}

std::size_t Grid::fullest_cell() const {
  std::int32_t most = 0;
  for (std::size_t k = 0; k < cell_count(); ++k) most = std::max(most, begins_[k + 1] - begins_[k]);
  return static_cast<std::size_t>(most);
}

std::size_t Grid::bytes() const {
  return keys_.size() * sizeof(keys_[0]) + begins_.size() * sizeof(begins_[0]) + bytes_of(order_) + bytes_of(items_) +
         bytes_of(items_scratch_);
}

}  // namespace sessile
