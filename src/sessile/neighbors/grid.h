#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sessile/core/array.h"
#include "sessile/core/radix_sort.h"

namespace sessile {

/// Contiguous places [begin, end) in the order of a grid.
struct PlaceRange {
  std::int32_t begin = 0;
  std::int32_t end = 0;
};

/// Cells of one axis: where they start, how long they are, and whether they close to a ring.
struct GridAxis {
  double origin = 0;        ///< [m]
  double cell = 1;          ///< length of a cell [m], a hair over the support radius
  double inverse_cell = 1;  ///< [1/m]
  std::int64_t ring = 0;    ///< number of cells around a periodic axis, or 0

  /// A cell's number on its ring.
  std::int64_t wrap(std::int64_t number) const { return ring == 0 ? number : ((number % ring) + ring) % ring; }

  /// The cell that holds x. Cells beyond 4e18 are not told apart; no float position in metres reaches that with cells
  /// above 1e-20 m.
  std::int64_t cell_of(Real x) const {
    const double place = std::floor((static_cast<double>(x) - origin) * inverse_cell);
    return wrap(static_cast<std::int64_t>(std::min(std::max(place, -4e18), 4e18)));
  }
};

/// How space is cut into cells no shorter than the support radius. Unbounded; periodic along some axes.
struct GridShape {
  std::array<GridAxis, 3> axes{};

  /// Cells for a support radius; along a periodic axis (period > 0) a whole number of them fills the period.
  static GridShape make(double support_radius, const Vec3d& origin, const Vec3d& period);

  /// Cell that holds the point, per axis.
  std::array<std::int64_t, 3> cell_of(const Vec3r& point) const {
    return {axes[0].cell_of(point.x), axes[1].cell_of(point.y), axes[2].cell_of(point.z)};
  }
};

/// The cells that hold points of one set, and which. Cells are sorted row by row (x runs fastest), so that the three
/// cells along x around a point are one contiguous range. Empty space costs nothing, however far the points stray.
class Grid {
 public:
  /// Finds the order that sorts the points by cell; equal cells keep their order. Throws RunError when the points lie
  /// so scattered that their cells cannot be numbered (more than 2^63 of them after gaps are closed up).
  void build(const Array3& points, const GridShape& shape);

  /// order()[k] is the point at place k. Callers reorder their points by it, and then places are indices.
  std::span<const std::int32_t> order() const { return order_; }

  /// The 9 rows of cells around the last cell asked for, and where the search in each ended: the next one, mostly in
  /// the same row, starts there.
  struct Cursor {
    struct Row {
      std::size_t begin = 0, end = 0;  // occupied cells of the row
      std::size_t at = 0;              // the first of them that the last search found
    };
    std::array<std::int64_t, 2> row_of{};  // y and z of the last cell
    bool fresh = true;
    std::array<Row, 9> rows{};
  };

  /// Ranges of places in the 27 cells around a cell, none empty; at most 18 (rows cut in two by a periodic face).
  /// Returns how many. Cheap when successive calls with one cursor ask for cells in the grid's order.
  int around(const std::array<std::int64_t, 3>& cell, Cursor& cursor, std::span<PlaceRange, 18> ranges) const;

  /// The occupied cell, counted in the grid's order, that holds a place.
  std::size_t cell_at(std::int32_t place) const;

  /// Where an occupied cell lies, per axis, and the places it holds.
  std::array<std::int64_t, 3> cell(std::size_t k) const;
  PlaceRange places(std::size_t k) const { return {begins_[k], begins_[k + 1]}; }

  const GridShape& shape() const { return shape_; }
  std::size_t cell_count() const { return keys_.size(); }
  std::size_t fullest_cell() const;  ///< most points in a cell
  std::size_t bytes() const;

 private:
  /// Numbers the cells of one axis 1, 2, 3 ... from the first occupied one, so that a key of few bits names a cell.
  /// Where strays lie so far out that keys would not fit 63 bits, gaps are closed up to one empty number.
  struct AxisNumbers {
    std::int64_t first = 0;
    std::int64_t count = 0;
    int bits = 0;
    std::vector<std::int64_t> occupied;  // only with gaps closed up: the occupied cells, ascending ...
    std::vector<std::int64_t> numbers;   // ... and their numbers

    std::int64_t number(std::int64_t cell) const {  // of an occupied cell
      return occupied.empty() ? cell - first + 1 : number_at_or_after(cell);
    }
    std::int64_t number_at_or_after(std::int64_t cell) const;   // of the first cell >= cell, or count + 1
    std::int64_t number_at_or_before(std::int64_t cell) const;  // of the last cell <= cell, or 0
    std::int64_t cell(std::int64_t number) const;               // that has the number
    void close_gaps(std::vector<std::int64_t> cells);
  };

  void number_axes(const Array3& points);
  std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) const;
  std::size_t seek(std::uint64_t key, std::size_t hint) const;
  void find_rows(const std::array<std::int64_t, 3>& cell, Cursor& cursor) const;

  GridShape shape_;
  std::array<AxisNumbers, 3> axes_;
  std::vector<std::uint64_t> keys_;   // occupied cells, ascending
  std::vector<std::int32_t> begins_;  // first place of each, and the end
  Array<std::int32_t> order_;
  Array<KeyedPlace> items_, items_scratch_;
};

}  // namespace sessile
