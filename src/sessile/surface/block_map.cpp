#include "sessile/surface/block_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sessile/core/bounds.h"
#include "sessile/core/error.h"
#include "sessile/core/parallel.h"

namespace sessile {
namespace {

/// a / b rounded down, for b > 0.
std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

double longest_reach(const Blobs& blobs) {
  return maximum(blobs.size(), [&](int i) {
    const Vec3<float>& reach = blobs.blobs[static_cast<std::size_t>(i)].reach;
    return static_cast<double>(std::max({reach.x, reach.y, reach.z}));
  });
}

double farthest_coordinate(const Blobs& blobs) {
  return maximum(blobs.size(), [&](int i) {
    const Vec3r at = blobs.centers[static_cast<std::size_t>(i)];
    return static_cast<double>(std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}));
  });
}

void sort_by_cell(Blobs& blobs, Grid& grid, const GridShape& shape) {
  grid.build(blobs.centers, shape);
  Blobs sorted;
  sorted.centers.resize(blobs.size());
  sorted.blobs.resize(blobs.size());
  for_each(blobs.size(), [&](int i) {
    const auto to = static_cast<std::size_t>(i), from = static_cast<std::size_t>(grid.order()[to]);
    sorted.centers.set(to, blobs.centers[from]);
    sorted.blobs[to] = blobs.blobs[from];
  });
  blobs = std::move(sorted);
}

/// First and last block along an axis that must hold points, for a blob at x with that reach, both in points.
struct BlockRange {
  std::int64_t first, last;

  BlockRange(double x, double reach)
      : first(floor_div(static_cast<std::int64_t>(std::ceil(x - reach)) - 1, block_edge)),
        last(floor_div(static_cast<std::int64_t>(std::floor(x + reach)) + 1, block_edge)) {}
};

}  // namespace

BlockMap::BlockMap(Blobs& blobs, double cube) : cube_(cube) {
  if (!(farthest_coordinate(blobs) < 1e18 * cube)) {
    throw Error("no surface: a particle lies so far out that the surface's grid cannot be numbered there");
  }
  const double farthest = longest_reach(blobs) / cube + 2;  // in points, and to the neighbours of the last
  if (!(farthest < 200)) {
    throw Error("the surface's grid is too fine for kernels that wide; make cube_size greater");
  }
  blocks_per_cell_ = static_cast<std::int64_t>(farthest / block_edge) + 1;
  GridShape shape;
  const double cell = static_cast<double>(blocks_per_cell_ * block_edge) * cube;
  for (GridAxis& axis : shape.axes) axis = {0, cell, 1 / cell, 0};
  sort_by_cell(blobs, grid_, shape);
  find_blocks(blobs);
  link();
}

std::array<std::int64_t, 3> BlockMap::cell(std::size_t block) const {
  const BlockPlace& at = places_[block];
  return {floor_div(at.x, blocks_per_cell_), floor_div(at.y, blocks_per_cell_), floor_div(at.z, blocks_per_cell_)};
}

void BlockMap::find_blocks(const Blobs& blobs) {
  const std::int64_t m = blocks_per_cell_, width = 3 * m;  // blobs of a cell reach the cells around it at most
  const double per_point = 1 / cube_;
  std::vector<std::vector<BlockPlace>> found(static_cast<std::size_t>(block_count(grid_.cell_count())));
  for_each_block(grid_.cell_count(), [&](std::ptrdiff_t block, std::ptrdiff_t begin, std::ptrdiff_t end) {
    std::vector<char> marked(static_cast<std::size_t>(width * width * width));
    for (auto c = static_cast<std::size_t>(begin); c < static_cast<std::size_t>(end); ++c) {
      const auto cell = grid_.cell(c);
      const BlockPlace corner{(cell[2] - 1) * m, (cell[1] - 1) * m, (cell[0] - 1) * m};
      std::fill(marked.begin(), marked.end(), 0);
      for (auto i = grid_.places(c).begin; i < grid_.places(c).end; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Vec3d at = per_point * vec_cast<double>(blobs.centers[k]);
        const Vec3d reach = per_point * vec_cast<double>(blobs.blobs[k].reach);
        const BlockRange x(at.x, reach.x), y(at.y, reach.y), z(at.z, reach.z);
        for (auto bz = z.first - corner.z; bz <= z.last - corner.z; ++bz) {
          for (auto by = y.first - corner.y; by <= y.last - corner.y; ++by) {
            for (auto bx = x.first - corner.x; bx <= x.last - corner.x; ++bx) {
              marked[static_cast<std::size_t>((bz * width + by) * width + bx)] = 1;
            }
          }
        }
      }
      for (std::int64_t k = 0; k < width * width * width; ++k) {
        if (marked[static_cast<std::size_t>(k)] == 0) continue;
        found[static_cast<std::size_t>(block)].push_back(
            {corner.z + k / (width * width), corner.y + k / width % width, corner.x + k % width});
      }
    }
  });
  for (const auto& some : found) places_.insert(places_.end(), some.begin(), some.end());
  std::sort(places_.begin(), places_.end());
  places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  if (places_.size() > most_indices) throw Error("the surface's grid has too many points; make cube_size greater");
}

void BlockMap::link() {
  ahead_.resize(places_.size());
  for (std::size_t k = 0; k < 8; ++k) {
    // The order of blocks is that of blocks as far ahead of them: one walk finds all.
    auto other = places_.begin();
    for (std::size_t block = 0; block < places_.size(); ++block) {
      const BlockPlace& at = places_[block];
      const BlockPlace wanted{at.z + static_cast<std::int64_t>(k >> 2), at.y + static_cast<std::int64_t>(k >> 1 & 1),
                              at.x + static_cast<std::int64_t>(k & 1)};
      while (other != places_.end() && *other < wanted) ++other;
      ahead_[block][k] =
          other != places_.end() && *other == wanted ? static_cast<std::int32_t>(other - places_.begin()) : no_block;
    }
  }
}

}  // namespace sessile
