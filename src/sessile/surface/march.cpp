#include "sessile/surface/march.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>

#include "sessile/core/error.h"
#include "sessile/core/first_error.h"
#include "sessile/surface/cube_table.h"

namespace sessile {
namespace {

/// One bit for each point of a block's layer, x fastest.
using Layer = std::uint64_t;
constexpr std::size_t layers = block_edge;

constexpr Layer first_column = 0x0101010101010101;  // the points with x = 0

constexpr Layer bit(int x, int y) { return Layer{1} << (block_edge * y + x); }

/// A crossing's vertices stand on the edges that start at a block's points: x edges layer by layer, then y, then z.
struct BlockOutline {
  std::array<Layer, layers> inside{};                        // points inside
  std::array<std::array<Layer, layers>, 3> crossed{};        // edges along x, y, z with one end inside
  std::array<std::array<std::uint32_t, layers>, 3> first{};  // vertex of the lowest bit of each
  std::uint64_t vertices = 0, triangles = 0;                 // how many; then the first
};

class Marcher {
 public:
  Marcher(const BlockMap& map, const BlockField& field, double unit) : map_(map), field_(field), unit_(unit) {}

  SurfaceMesh run() {
    outlines_.resize(map_.size());
    for_each_map_block([&](std::size_t b) { find_inside(b); });
    for_each_map_block([&](std::size_t b) { find_crossed(b); });
    number();
    for_each_map_block([&](std::size_t b) { place_vertices(b); });
    for_each_map_block([&](std::size_t b) { write_triangles(b); });
    return std::move(mesh_);
  }

 private:
  template <class F>
  void for_each_map_block(const F& f) const {
    const auto count = static_cast<std::ptrdiff_t>(map_.size());
    FirstError error;
#pragma omp parallel for schedule(dynamic, 32)
    for (std::ptrdiff_t b = 0; b < count; ++b) error.guard([&] { f(static_cast<std::size_t>(b)); });
    error.rethrow();
  }

  void find_inside(std::size_t b) {
    const float* values = field_.blocks[b].at.data();
    for (Layer& layer : outlines_[b].inside) {
      layer = 0;
      for (int k = 0; k < 64; ++k) layer |= Layer{*values++ > 0} << k;
    }
  }

  Layer inside(std::int32_t block, std::size_t z) const {
    return block == BlockMap::no_block ? 0 : outlines_[static_cast<std::size_t>(block)].inside[z];
  }

  /// Whether the points one step ahead along the axes of `corner` are inside, at the bits of the points themselves.
  Layer ahead(std::size_t b, std::size_t z, unsigned corner) const {
    const BlockMap::Ahead& near = map_.ahead(b);
    const bool x = corner & 1, y = corner & 2;
    const unsigned up = (corner & 4) != 0 && z == layers - 1 ? 4 : 0;
    const std::size_t layer = (corner & 4) == 0 ? z : (z + 1) % layers;
    const auto along_y = [&](unsigned beside) {
      const Layer own = inside(near[up + beside], layer);
      return y ? own >> block_edge | inside(near[up + beside + 2], layer) << (64 - block_edge) : own;
    };
    const Layer own = along_y(0);
    return x ? (own >> 1 & ~(first_column << 7)) | (along_y(1) & first_column) << 7 : own;
  }

  using Corners = std::array<Layer, corner_count>;
  Corners corners(std::size_t b, std::size_t z) const {
    Corners all;
    for (unsigned k = 0; k < corner_count; ++k) all[k] = ahead(b, z, k);
    return all;
  }
  static Layer cut(const Corners& corners) {
    Layer any = 0, all = ~Layer{0};
    for (const Layer layer : corners) any |= layer, all &= layer;
    return any & ~all;
  }
  static unsigned case_of(const Corners& corners, int k) {
    unsigned inside = 0;
    for (unsigned corner = 0; corner < corner_count; ++corner) {
      inside |= static_cast<unsigned>(corners[corner] >> k & 1) << corner;
    }
    return inside;
  }

  /// Calls f(bit number) for every bit that is set.
  template <class F>
  static void for_each_bit(Layer layer, const F& f) {
    for (; layer != 0; layer &= layer - 1) f(std::countr_zero(layer));
  }

  void find_crossed(std::size_t b) {
    BlockOutline& outline = outlines_[b];
    for (std::size_t z = 0; z < layers; ++z) {
      const Corners near = corners(b, z);
      for (unsigned axis = 0; axis < 3; ++axis) {
        outline.crossed[axis][z] = near[0] ^ near[1u << axis];
        outline.vertices += static_cast<std::uint64_t>(std::popcount(outline.crossed[axis][z]));
      }
      for_each_bit(cut(near),
                   [&](int k) { outline.triangles += static_cast<std::uint64_t>(table_[case_of(near, k)].triangles); });
    }
  }

  void number() {
    std::uint64_t vertices = 0, triangles = 0;
    for (BlockOutline& outline : outlines_) {
      std::uint64_t next = vertices;
      vertices += std::exchange(outline.vertices, vertices);
      triangles += std::exchange(outline.triangles, triangles);
      for (unsigned axis = 0; axis < 3; ++axis) {
        for (std::size_t z = 0; z < layers; ++z) {
          outline.first[axis][z] = static_cast<std::uint32_t>(next);
          next += static_cast<std::uint64_t>(std::popcount(outline.crossed[axis][z]));
        }
      }
    }
    if (vertices > std::numeric_limits<std::uint32_t>::max()) {
      throw Error("the surface would have more than 4 billion vertices; make cube_size greater");
    }
    mesh_.points.resize(3 * vertices);
    mesh_.triangles.resize(3 * triangles);
  }

  float value(std::int32_t block, int x, int y, int z) const {
    return field_.blocks[static_cast<std::size_t>(block)].at[point_index(x, y, z)];
  }

  void place_vertices(std::size_t b) {
    const BlockOutline& outline = outlines_[b];
    const BlockPlace& place = map_.place(b);
    std::size_t vertex = outline.vertices;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3<int> step{axis == 0, axis == 1, axis == 2};
      for (int z = 0; z < block_edge; ++z) {
        for_each_bit(outline.crossed[static_cast<std::size_t>(axis)][static_cast<std::size_t>(z)], [&](int k) {
          const int x = k % block_edge, y = k / block_edge;
          const bool leaves = (step.x != 0 ? x : step.y != 0 ? y : z) == block_edge - 1;
          const std::int32_t other = map_.ahead(b)[leaves ? 1u << axis : 0];
          const auto wrap = [](int at) { return at % block_edge; };
          const float from = value(static_cast<std::int32_t>(b), x, y, z);
          const float to = value(other, wrap(x + step.x), wrap(y + step.y), wrap(z + step.z));
          const double part = crossing(from, to);
          const auto at = [&](std::int64_t block, int point, int along) {
            return static_cast<float>((static_cast<double>(block * block_edge + point) + along * part) * map_.cube() *
                                      unit_);
          };
          mesh_.points[3 * vertex] = at(place.x, x, step.x);
          mesh_.points[3 * vertex + 1] = at(place.y, y, step.y);
          mesh_.points[3 * vertex + 2] = at(place.z, z, step.z);
          ++vertex;
        });
      }
    }
  }

  /// Where on an edge the field is 0, kept off its ends: triangles there would have no area.
  static double crossing(float from, float to) {
    constexpr double margin = 1. / 32;
    const double part = static_cast<double>(from) / (static_cast<double>(from) - static_cast<double>(to));
    return std::clamp(part, margin, 1 - margin);
  }

  std::uint32_t vertex_on(std::size_t b, int x, int y, int z, int edge) const {
    const int start = edge_start(edge);
    x += start & 1, y += start >> 1 & 1, z += start >> 2;
    const unsigned beyond = static_cast<unsigned>(x >= block_edge) | static_cast<unsigned>(y >= block_edge) << 1 |
                            static_cast<unsigned>(z >= block_edge) << 2;
    const BlockOutline& outline = outlines_[static_cast<std::size_t>(map_.ahead(b)[beyond])];
    const auto axis = static_cast<std::size_t>(edge / 4), layer = static_cast<std::size_t>(z % block_edge);
    const Layer before = bit(x % block_edge, y % block_edge) - 1;
    return outline.first[axis][layer] +
           static_cast<std::uint32_t>(std::popcount(outline.crossed[axis][layer] & before));
  }

  void write_triangles(std::size_t b) {
    std::size_t at = 3 * outlines_[b].triangles;
    for (int z = 0; z < block_edge; ++z) {
      const Corners near = corners(b, static_cast<std::size_t>(z));
      for_each_bit(cut(near), [&](int k) {
        const CubeCase& cut = table_[case_of(near, k)];
        for (std::size_t corner = 0; corner < 3 * static_cast<std::size_t>(cut.triangles); ++corner) {
          mesh_.triangles[at++] = vertex_on(b, k % block_edge, k / block_edge, z, cut.edges[corner]);
        }
      });
    }
  }

  const BlockMap& map_;
  const BlockField& field_;
  const double unit_;
  const CubeTable table_;
  std::vector<BlockOutline> outlines_;
  SurfaceMesh mesh_;
};

}  // namespace

SurfaceMesh march(const BlockMap& map, const BlockField& field, double unit) { return Marcher(map, field, unit).run(); }

}  // namespace sessile
