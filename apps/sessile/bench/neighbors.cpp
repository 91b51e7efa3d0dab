#include <fmt/format.h>

#include <cstdint>

#include "bench/context.h"
#include "bench/scenes.h"
#include "sessile/core/space.h"
#include "sessile/neighbors/grid.h"
#include "sessile/neighbors/neighbors.h"
#include "sessile/particles/particles.h"

namespace sessile::app::bench {
namespace {

constexpr double spacing = 0.1, support_radius = 2 * spacing;

/// A number in -1 ... 1 that follows from three others alone (splitmix64).
double scattered(std::uint64_t id, std::uint64_t axis, std::uint64_t turn) {
  std::uint64_t z = (id * 3 + axis + 1) * 0x9E3779B97F4A7C15u + turn * 0xD1B54A32D192ED03u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) / static_cast<double>(std::uint64_t{1} << 52) - 1;
}

/// Place of a lattice's point, shifted by up to a fifth of dx for good and by up to a twentieth anew each turn: as far
/// as particles move in a step, and over the cells' borders both ways.
Vec3r place(std::int64_t id, int edge, int turn) {
  const std::int64_t cell[3] = {id % edge, id / edge % edge, id / edge / edge};
  double x[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto number = static_cast<std::uint64_t>(id);
    const double shift =
        0.2 * scattered(number, axis, 0) + 0.05 * scattered(number, axis, static_cast<std::uint64_t>(turn));
    x[axis] = spacing * (static_cast<double>(cell[axis]) + shift);
  }
  return vec_cast<Real>(Vec3d{x[0], x[1], x[2]});
}

}  // namespace

void bench_neighbors(Context& context) {
  const int edge = edge_of(context.particles > 0 ? context.particles : 1'000'000);
  const std::int64_t n = std::int64_t{edge} * edge * edge;
  context.report.section(fmt::format("Neighbours of {} jittered points, h = 2 dx", n));

  Particles particles;
  for (std::int64_t id = 0; id < n; ++id) particles.add(place(id, edge, 0), {}, 1, id);
  const GridShape shape = GridShape::make(support_radius, {}, {});
  Grid grid;
  NeighborList list;
  Figure sort{"neighbors.sort", "sort by cells, every array", "ms", {}}, build{"neighbors.list", "list", "ms", {}},
      together{"neighbors.together", "both", "ms", {}};
  for (int turn = 0; turn <= context.runs; ++turn) {
    for (std::size_t k = 0; k < particles.size(); ++k)
      particles.position.set(k, place(particles.id[k], edge, turn + 1));
    const double sorted = seconds([&] {
      grid.build(particles.position, shape);
      particles.reorder(grid.order());
    });
    const double built = seconds([&] {
      const SortedPoints points{particles.position, grid};
      list.build(points, points, Space{}, static_cast<Real>(support_radius));
    });
    if (turn == 0) continue;  // finds no memory yet, and particles in no order
    sort.samples.push_back(1e3 * sorted);
    build.samples.push_back(1e3 * built);
    together.samples.push_back(1e3 * (sorted + built));
  }
  double pairs = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) pairs += list.count(i);
  context.report.add(std::move(sort));
  context.report.add(std::move(build));
  context.report.add(std::move(together));
  context.report.add({"neighbors.count", "neighbours of a particle", "", {pairs / static_cast<double>(n)}});
}

}  // namespace sessile::app::bench
