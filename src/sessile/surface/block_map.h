#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "sessile/neighbors/grid.h"
#include "sessile/surface/blobs.h"

/// The grid of points that carries the field, in blocks of 8^3, only where there are particles. Internal.
namespace sessile {

inline constexpr int block_edge = 8;  ///< points along a block's edge
inline constexpr int block_points = block_edge * block_edge * block_edge;

/// Where a block keeps a point: x runs fastest.
constexpr std::size_t point_index(int x, int y, int z) {
  const int index = block_edge * (block_edge * z + y) + x;
  return static_cast<std::size_t>(index);
}

/// A block's place in the grid of blocks; blocks are in the order of z, then y, then x.
struct BlockPlace {
  std::int64_t z = 0, y = 0, x = 0;
  auto operator<=>(const BlockPlace&) const = default;  // NOLINT(modernize-use-nullptr): it sees a 0 in there
};

/// The blocks that hold every point that a blob reaches and every neighbour of such a point, and the blobs in cells
/// that are whole numbers of blocks and longer than any blob's reach.
class BlockMap {
 public:
  static constexpr std::int32_t no_block = -1;
  /// Of a block, the blocks at (k & 1, k >> 1 & 1, k >> 2) from it, itself first; no_block where there is none.
  using Ahead = std::array<std::int32_t, 8>;

  /// Sorts the blobs by cell on the way; order() is what became of them. `cube` is the distance of points.
  BlockMap(Blobs& blobs, double cube);

  std::size_t size() const { return places_.size(); }
  const BlockPlace& place(std::size_t block) const { return places_[block]; }
  const Ahead& ahead(std::size_t block) const { return ahead_[block]; }
  double cube() const { return cube_; }

  const Grid& grid() const { return grid_; }
  /// The cell of the grid that a block lies in.
  std::array<std::int64_t, 3> cell(std::size_t block) const;

 private:
  void find_blocks(const Blobs& blobs);
  void link();

  double cube_;
  std::int64_t blocks_per_cell_;
  Grid grid_;
  std::vector<BlockPlace> places_;
  std::vector<Ahead> ahead_;
};

}  // namespace sessile
