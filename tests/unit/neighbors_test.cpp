#include "sessile/neighbors/neighbors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "support/cloud.h"

namespace sessile {
namespace {

constexpr Real radius = Real(0.2);

Array3 random_points(int n, double extent, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-extent / 2, extent / 2);
  Array3 points;
  for (int i = 0; i < n; ++i) points.push_back(vec_cast<Real>(Vec3d{place(random), place(random), place(random)}));
  return points;
}

Array3 clustered_points(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> place(0, 0.15);
  Array3 points;
  for (int cluster = 0; cluster < 6; ++cluster) {
    for (int i = 0; i < 150; ++i) {
      const Vec3d x{cluster * 0.7 + place(random), place(random), cluster % 2 * 0.5 + place(random)};
      points.push_back(vec_cast<Real>(x));
    }
  }
  return points;
}

Array3 sorted_by(const Grid& grid, const Array3& points) {
  Array3 sorted;
  for (const std::int32_t k : grid.order()) sorted.push_back(points[static_cast<std::size_t>(k)]);
  return sorted;
}

/// Lists of `points` among `others` (both in the order of their grids) are the sets that all pairs give.
void expect_all_pairs(const Array3& points, const Array3& others, bool same, const NeighborList& list,
                      const Space& space) {
  ASSERT_EQ(list.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::set<std::int32_t> expected;
    for (std::size_t j = 0; j < others.size(); ++j) {
      if (same && i == j) continue;
      if (squared_length(space.displacement(points[i], others[j])) < radius * radius) {
        expected.insert(static_cast<std::int32_t>(j));
      }
    }
    const std::set<std::int32_t> found(list[i].begin(), list[i].end());
    ASSERT_EQ(found.size(), list[i].size()) << "a neighbour twice, particle " << i;
    ASSERT_EQ(found, expected) << "particle " << i;
  }
}

void check_against_all_pairs(const Array3& unsorted, const Space& space = {}, const Vec3d& origin = {}) {
  const GridShape shape = GridShape::make(static_cast<double>(radius), origin, vec_cast<double>(space.period));
  for (const int threads : {1, 2, 8}) {
    test::with_threads(threads, [&] {
      Grid grid;
      grid.build(unsorted, shape);
      const Array3 points = sorted_by(grid, unsorted);
      NeighborList list;
      list.build({points, grid}, {points, grid}, space, radius);
      expect_all_pairs(points, points, true, list, space);
    });
  }
}

TEST(Neighbors, EqualAllPairsInARandomCloud) { check_against_all_pairs(random_points(3000, 1.5, 1)); }

TEST(Neighbors, EqualAllPairsInClusters) { check_against_all_pairs(clustered_points(2)); }

TEST(Neighbors, EqualAllPairsOnALatticeWhereManyPairsAreExactlyAtTheRadius) {
  Array3 points;
  for (int i = 0; i < 1000; ++i) {
    points.push_back({Real(0.1) * Real(i % 10), Real(0.1) * Real(i / 10 % 10), Real(0.1) * Real(i / 100)});
  }
  check_against_all_pairs(points);
}

TEST(Neighbors, EqualAllPairsWithStraysAMillionRadiiAway) {
  Array3 points = random_points(800, 1, 3);
  for (const double far : {1e6, -1e6, 1e9, -1e12, 1e15}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3d x;
      (axis == 0 ? x.x : axis == 1 ? x.y : x.z) = far * static_cast<double>(radius);
      points.push_back(vec_cast<Real>(x));
      points.push_back(vec_cast<Real>(x));  // a pair out there
    }
  }
  check_against_all_pairs(points);
}

TEST(Neighbors, EqualAllPairsAcrossPeriodicFaces) {
  // 0.6 m is three radii: with the cells' margin, two cells. 0.41 m is the least period that has one nearest image.
  for (const double period : {1.3, 0.6, 0.41})
    for (const int axes : {1, 2, 4, 7}) {
      Space space;
      space.periodic = true;
      const auto close = [&](bool on, Real& length, Real& inverse) {
        if (on) length = static_cast<Real>(period), inverse = 1 / length;
      };
      close(axes & 1, space.period.x, space.inverse_period.x);
      close(axes & 2, space.period.y, space.inverse_period.y);
      close(axes & 4, space.period.z, space.inverse_period.z);
      check_against_all_pairs(random_points(period > 1 ? 1500 : 200, period, 4), space,
                              Vec3d{-0.5, -0.5, -0.5} * period);
    }
}

TEST(Neighbors, EqualAllPairsBetweenTwoSets) {
  const GridShape shape = GridShape::make(static_cast<double>(radius), {}, {});
  Grid grid, other_grid;
  const Array3 unsorted = random_points(500, 3, 5), unsorted_others = random_points(900, 1, 6);
  grid.build(unsorted, shape);
  other_grid.build(unsorted_others, shape);
  const Array3 points = sorted_by(grid, unsorted), others = sorted_by(other_grid, unsorted_others);
  NeighborList list;
  list.build({points, grid}, {others, other_grid}, {}, radius);
  expect_all_pairs(points, others, false, list, {});
  NeighborList none;
  Grid empty;
  empty.build({}, shape);
  const Array3 nothing;
  none.build({points, grid}, {nothing, empty}, {}, radius);
  expect_all_pairs(points, {}, false, none, {});
}

TEST(Neighbors, SurviveASecondBuildWithOtherPoints) {
  NeighborList list;
  for (const unsigned seed : {7u, 8u, 9u}) {
    const Array3 unsorted = random_points(seed == 8 ? 2500 : 600, 1, seed);
    Grid grid;
    grid.build(unsorted, GridShape::make(static_cast<double>(radius), {}, {}));
    const Array3 points = sorted_by(grid, unsorted);
    list.build({points, grid}, {points, grid}, {}, radius);
    expect_all_pairs(points, points, true, list, {});
  }
}

TEST(Grid, OrdersStablyAndCompletely) {
  const Array3 points = random_points(70000, 4, 10);  // more than one chunk of the sort
  Grid one, many;
  const GridShape shape = GridShape::make(static_cast<double>(radius), {}, {});
  test::with_threads(1, [&] { one.build(points, shape); });
  test::with_threads(8, [&] { many.build(points, shape); });
  ASSERT_TRUE(std::equal(one.order().begin(), one.order().end(), many.order().begin(), many.order().end()));
  std::vector<std::int32_t> all(one.order().begin(), one.order().end());
  for (std::size_t k = 1; k < all.size(); ++k) {
    const auto a = shape.cell_of(points[static_cast<std::size_t>(all[k - 1])]);
    const auto b = shape.cell_of(points[static_cast<std::size_t>(all[k])]);
    const auto key_a = std::tuple{a[2], a[1], a[0], all[k - 1]}, key_b = std::tuple{b[2], b[1], b[0], all[k]};
    ASSERT_LT(key_a, key_b);
  }
}

TEST(Grid, EmptySpaceCostsNothing) {
  Array3 points = random_points(100, 1, 11);
  Grid near, far;
  const GridShape shape = GridShape::make(static_cast<double>(radius), {}, {});
  near.build(points, shape);
  points.push_back({Real(1e9), Real(-1e9), Real(1e9)});
  far.build(points, shape);
  EXPECT_EQ(far.cell_count(), near.cell_count() + 1);
}

}  // namespace
}  // namespace sessile
