#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sessile/core/error.h"
#include "sessile/core/lanes.h"
#include "sessile/kernels/cubic_spline.h"
#include "sessile/neighbors/neighbors.h"
#include "sessile/simulation.h"
#include "sessile/surface/reconstruct.h"
#include "support/scenes.h"

/// What crowds into one place, or lies much closer than particles do, takes no memory for all of its pairs.
namespace sessile {
namespace {

template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

Array3 sorted_cloud(std::size_t n, Grid& grid, const GridShape& shape) {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> place(0, 2);
  Array3 points;
  for (std::size_t k = 0; k < n; ++k) points.push_back({place(random), place(random), place(random)});
  grid.build(points, shape);
  Array3 sorted;
  for (const std::int32_t k : grid.order()) sorted.push_back(points[static_cast<std::size_t>(k)]);
  return sorted;
}

TEST(Crowding, PartsHaveTheListsOfTheWhole) {
  constexpr Real radius = 0.25;  // float holds it
  Grid grid;
  const Array3 points = sorted_cloud(3000, grid, GridShape::make(radius, {}, {}));
  const SortedPoints all{points, grid};
  NeighborList whole, some;
  whole.build(all, all, Space{}, radius);
  for (const std::int32_t size : {lane_count, 5 * lane_count, 512, 1024}) {
    for (std::int32_t begin = 0; begin < 3000; begin += size) {
      const PlaceRange part{begin, std::min(3000, begin + size)};
      some.build(all, all, Space{}, radius, part);
      ASSERT_EQ(some.size(), static_cast<std::size_t>(part.end - part.begin));
      for (std::size_t k = 0; k < some.size(); ++k) {
        const Neighbors a = some[k], b = whole[static_cast<std::size_t>(begin) + k];
        ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << begin << " + " << k;
      }
    }
  }
}

TEST(Crowding, PartsAreWholeGroupsAndAllOfThem) {
  for (const std::size_t fullest : {0U, 8U, 5000U, 600'000U}) {
    std::int32_t next = 0;
    for (const PlaceRange& part : parts_of(100'000, fullest)) {
      ASSERT_EQ(part.begin, next);
      ASSERT_EQ(part.begin % lane_count, 0);
      ASSERT_GT(part.end, part.begin);
      next = part.end;
    }
    EXPECT_EQ(next, 100'000);
  }
  EXPECT_EQ(parts_of(100'000, 8).size(), 1U);
  EXPECT_GT(parts_of(100'000, 5000).size(), 100U);
}

TEST(Crowding, FineSamplesOfSolidsHaveTheirPsi) {
  Scene scene = test::block(2);
  scene.bodies[0].placement.position = {0, 0, 1};
  Solid plate;
  plate.shape = Plate{0.3, 0.3};
  plate.spacing = 0.006;
  scene.solids = {plate};
  const Simulation simulation(scene);
  const Walls& walls = simulation.walls();
  const std::size_t n = walls.size();
  Grid grid;
  grid.build(walls.position, GridShape::make(scene.support_radius(), {}, {}));
  ASSERT_GT(parts_of(n, grid.fullest_cell()).size(), 1U) << "or parts would not be tested";
  const CubicSpline W(scene.support_radius(), scene.spacing);
  for (std::size_t k = 0; k < n; k += 7) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j)
      sum += static_cast<double>(W.value(length(walls.position[k] - walls.position[j])));
    ASSERT_NEAR(static_cast<double>(walls.psi[k]) * sum, 1, 1e-4) << k;
  }
}

/// Half a million pairs of bodies: a hundred are named.
TEST(Crowding, BodiesAtOnePlaceAreRefusedAtOnce) {
  Scene scene = test::block(3);
  scene.bodies.assign(1000, scene.bodies[0]);
  const std::string told = message_of([&] { const Simulation simulation(scene); });
  EXPECT_NE(told.find("bodies[0] \"block\" and bodies[1] \"block\" overlap"), std::string::npos)
      << told.substr(0, 1000);
  EXPECT_NE(told.find("more than 100 such faults"), std::string::npos);
  EXPECT_LT(told.size(), 10'000U);
}

TEST(Crowding, SurfacesAreNotMadeOfIt) {
  Snapshot frame{0, 0, {}, {}};
  for (int k = 0; k < 4096; ++k) frame.points.insert(frame.points.end(), {0.25F, 0.25F, 0.25F});
  const auto told = [&] { return message_of([&] { reconstruct(frame, 0.1, SurfaceSettings{}); }); };
  frame.points.insert(frame.points.end(), {0.25F, 0.25F, 0.25F});
  EXPECT_NE(told().find("4097 particles of the frame crowd into one cube"), std::string::npos) << told();
  frame.points = {0, 0, 0, 3e38F, 0, 0};
  // In spacings a float cannot hold it any more, a double can.
  const char* const expected = sizeof(Real) == sizeof(float)
                                   ? "particle 1 of the frame is at no finite place once it is measured in spacings"
                                   : "a particle lies so far out that the surface's grid cannot be numbered there";
  EXPECT_NE(told().find(expected), std::string::npos) << told();
}

}  // namespace
}  // namespace sessile
