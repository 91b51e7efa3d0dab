#include "sessile/measure/diagnostics.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

namespace sessile {
namespace {

/// Neighbour lists by trying all pairs.
class AllPairs {
 public:
  AllPairs(const Array3& points, const Array3& others, const Space& space, double radius, bool same)
      : lists_(points.size()) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < others.size(); ++j) {
        if (same && i == j) continue;
        if (length(vec_cast<double>(space.displacement(points[i], others[j]))) < radius)
          lists_[i].push_back(static_cast<std::int32_t>(j));
      }
    }
    std::mt19937 random(5);  // lists promise no order
    for (auto& list : lists_) {
      std::shuffle(list.begin(), list.end(), random);
      groups_.push_back({list.data(), static_cast<std::int32_t>(list.size())});
      counts_.push_back(static_cast<std::int32_t>(list.size()));
    }
  }
  NeighborRows rows() const { return {groups_.data(), counts_.data()}; }
  const std::vector<std::int32_t>& operator[](std::size_t i) const { return lists_[i]; }

 private:
  std::vector<std::vector<std::int32_t>> lists_;
  std::vector<NeighborGroup> groups_;
  std::vector<std::int32_t> counts_;
};

/// A cloud with lists of its own, h = 2 dx.
struct Sample {
  Array3 position, wall;
  double spacing = 0.1;
  Space space{};

  Structure measured() const {
    const double h = 2 * spacing;
    const AllPairs fluid(position, position, space, h, true);
    const AllPairs walls(position, wall, space, h, false);
    return structure({position, wall, fluid.rows(), walls.rows(), space, spacing, h});
  }
};

Array3 lattice(int nx, int ny, int nz, double spacing, const Vec3d& corner = {}) {
  Array3 points;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        points.push_back(vec_cast<Real>(
            corner + spacing * Vec3d{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}));
  return points;
}

void append(Array3& points, const Array3& more) {
  for (std::size_t i = 0; i < more.size(); ++i) points.push_back(more[i]);
}

Array3 random_points(std::size_t n, double edge) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, edge);
  Array3 points;
  for (std::size_t i = 0; i < n; ++i)
    points.push_back(vec_cast<Real>(Vec3d{place(random), place(random), place(random)}));
  return points;
}

TEST(Motion, AddsEnergiesAndMomentum) {
  Array3 x, v;
  x.push_back({0, 0, 2});
  x.push_back({1, 0, 5});
  v.push_back({1, 2, 2});   // speed 3
  v.push_back({0, -4, 0});  // speed 4
  const Array<Real> mass{1, 0.5};
  const Motion m = motion(x, v, mass, 8, {0, 0, -10});
  EXPECT_NEAR(m.kinetic_energy, 0.5 * 8 * 9 + 0.5 * 4 * 16, 1e-12);
  EXPECT_NEAR(m.potential_energy, 10 * (8 * 2 + 4 * 5), 1e-12);
  EXPECT_EQ(m.momentum, (Vec3d{8, 0, 16}));
  EXPECT_NEAR(m.max_speed, 4, 1e-12);
}

TEST(Extent, OfACubeLatticeIsTheFormula) {
  const int n = 7;
  const double dx = 0.1;
  const Array3 x = lattice(n, n, n, dx, {3, -2, 1});
  const Array<Real> mass(x.size(), Real(0.8));
  const Extent e = extent(x, mass);
  EXPECT_NEAR(e.centre.x, 3 + 0.3, 1e-6);
  EXPECT_NEAR(e.centre.y, -2 + 0.3, 1e-6);
  EXPECT_NEAR(e.centre.z, 1 + 0.3, 1e-6);
  EXPECT_NEAR(e.radius_of_gyration, dx * std::sqrt((n * n - 1) / 4.0), 1e-6);
  EXPECT_NEAR(e.farthest, dx * std::sqrt(3.0) * (n - 1) / 2, 1e-6);
}

TEST(Extent, WeighsByMass) {
  Array3 x;
  x.push_back({0, 0, 0});
  x.push_back({4, 0, 0});
  const Extent e = extent(x, Array<Real>{3, 1});
  EXPECT_NEAR(e.centre.x, 1, 1e-12);
  EXPECT_NEAR(e.radius_of_gyration, std::sqrt((3 * 1 + 1 * 9) / 4.0), 1e-12);
  EXPECT_NEAR(e.farthest, 3, 1e-12);
}

TEST(Compression, LeavesDeficitsOut) {
  const Compression c = compression({Real(1.5), Real(0.25), Real(1), Real(1.25)});
  EXPECT_NEAR(c.average, 0.75 / 4, 1e-12);
  EXPECT_NEAR(c.max, 0.5, 1e-12);
}

TEST(Diagnostics, OfNothingAreZero) {
  EXPECT_EQ(motion({}, {}, {}, 1, {0, 0, -9.81}).kinetic_energy, 0);
  EXPECT_EQ(extent({}, {}).radius_of_gyration, 0);
  EXPECT_EQ(compression({}).average, 0);
  const Structure s = Sample{}.measured();
  EXPECT_EQ(s.pieces, 0);
  EXPECT_EQ(s.largest_share, 0);
  EXPECT_EQ(s.nearest_median, 0);
}

TEST(Structure, CountsPieces) {
  Sample sample;
  sample.position = lattice(4, 4, 4, 0.1);                        // 64
  append(sample.position, lattice(3, 1, 1, 0.1, {0.46, 0, 0}));   // 1.6 dx off: a piece of its own
  append(sample.position, lattice(2, 1, 1, 0.1, {-0.24, 0, 0}));  // 1.4 dx off: part of the cube
  append(sample.position, lattice(1, 1, 1, 0.1, {5, 0, 0}));
  const Structure s = sample.measured();
  EXPECT_EQ(s.pieces, 3);
  EXPECT_NEAR(s.largest_share, 66.0 / 70, 1e-12);
}

TEST(Structure, LinksAChainWhateverTheOrder) {
  Sample sample;
  const int n = 4507;  // several blocks, linked from the ends inwards and out again
  for (int i = 0; i < n; ++i) {
    const int place = (i * 2003) % n;
    sample.position.push_back({Real(0.1) * static_cast<Real>(place), 0, 0});
  }
  EXPECT_EQ(sample.measured().pieces, 1);
}

TEST(Structure, LinksAcrossAPeriodicFace) {
  Sample sample;
  sample.position.push_back({Real(0.02), 0, 0});
  sample.position.push_back({Real(0.95), 0, 0});
  EXPECT_EQ(sample.measured().pieces, 2);
  sample.space = {{1, 0, 0}, {1, 0, 0}, true};
  const Structure s = sample.measured();
  EXPECT_EQ(s.pieces, 1);
  EXPECT_NEAR(s.nearest_min, 0.7, 1e-5);
}

TEST(Structure, CountsLooseParticles) {
  Sample sample;
  sample.position = lattice(5, 1, 1, 0.1);                     // at most 2 neighbours within h: all loose
  append(sample.position, lattice(3, 3, 3, 0.1, {0, 0, 3}));   // none
  append(sample.position, lattice(1, 1, 1, 0.1, {0, 0, -5}));  // alone, but at a wall
  sample.wall = lattice(1, 1, 1, 0.1, {0, 0, -5.19});
  EXPECT_EQ(sample.measured().loose, 5);
}

TEST(Structure, LooseMeansAtMostFourNeighbours) {
  Sample sample;
  sample.position.push_back({0, 0, 0});
  for (const Real x : {Real(-0.15), Real(0.15)}) sample.position.push_back({x, 0, 0});
  for (const Real y : {Real(-0.15), Real(0.15)}) sample.position.push_back({0, y, 0});
  EXPECT_EQ(sample.measured().loose, 1 + 4);  // the ends see the middle, and each other only at 0.21
  sample.position.push_back({0, 0, Real(0.15)});
  EXPECT_EQ(sample.measured().loose, 5);  // the middle now has five
}

TEST(Structure, MeasuresTheWettedArea) {
  Sample sample;
  sample.position = lattice(4, 5, 3, 0.1, {0.1, 0.1, 0.1});
  sample.wall = lattice(12, 12, 1, 0.1);
  const Structure s = sample.measured();
  EXPECT_EQ(s.first_layer, 20);
  EXPECT_NEAR(s.wetted_area, 0.2, 1e-12);
}

TEST(Structure, CountsWhatSolidsHold) {
  Sample sample;
  sample.wall = lattice(12, 12, 1, 0.1);
  sample.position = lattice(2, 2, 5, 0.1, {0.1, 0.1, 0.2});  // a pillar on the wall, its top first: held
  append(sample.position, lattice(2, 2, 1, 0.1, {0.1, 0.1, 0.1}));
  append(sample.position, lattice(3, 3, 3, 0.1, {0.6, 0.6, 0.155}));  // hovers 1.55 dx above it: not held
  append(sample.position, lattice(1, 1, 1, 0.1, {0.1, 0.9, 0.1}));    // alone on the wall: held
  const Structure s = sample.measured();
  EXPECT_EQ(s.pieces, 3);
  EXPECT_EQ(s.first_layer, 5);
  EXPECT_EQ(s.held, 25);
}

TEST(Structure, DescribesClustering) {
  Sample sample;
  for (int i = 0; i < 20; ++i) sample.position.push_back({static_cast<Real>(i), 0, 0});
  for (int i = 0; i < 19; ++i) sample.position.push_back({static_cast<Real>(i), Real(0.1), 0});
  sample.position.push_back({0, Real(0.05), 0});
  // 0.5 dx for three, h = 2 dx for the lonely last one, dx for all others
  const Structure s = sample.measured();
  EXPECT_NEAR(s.nearest_min, 0.5, 1e-5);
  EXPECT_NEAR(s.nearest_p5, 0.5, 1e-5);
  EXPECT_NEAR(s.nearest_median, 1, 1e-5);
}

TEST(Structure, AgreesWithBruteForceOnARandomCloud) {
  Sample sample;
  sample.position = random_points(1500, 1.6);
  sample.wall = random_points(40, 1.6);
  const Array3& x = sample.position;
  const std::size_t n = x.size();
  const AllPairs links(x, x, {}, 0.15, true), near(x, x, {}, 0.2, true), wall(x, sample.wall, {}, 0.2, false),
      touching(x, sample.wall, {}, 0.15, false);

  std::int64_t loose = 0, first_layer = 0, pieces = 0, held = 0;
  std::size_t largest = 0;
  std::vector<bool> seen(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    if (near[i].size() <= 4 && wall[i].empty()) ++loose;
    if (!touching[i].empty()) ++first_layer;
    if (seen[i]) continue;
    ++pieces;
    std::size_t size = 0;
    std::vector<std::size_t> open{i};
    seen[i] = true;
    bool clings = false;
    while (!open.empty()) {
      const std::size_t a = open.back();
      open.pop_back();
      ++size;
      clings = clings || !touching[a].empty();
      for (const std::int32_t j : links[a]) {
        const auto b = static_cast<std::size_t>(j);
        if (!seen[b]) open.push_back(b);
        seen[b] = true;
      }
    }
    largest = std::max(largest, size);
    if (clings) held += static_cast<std::int64_t>(size);
  }
  const Structure s = sample.measured();
  EXPECT_GT(pieces, 20);  // the cloud is a test of something
  EXPECT_EQ(s.pieces, pieces);
  EXPECT_NEAR(s.largest_share, static_cast<double>(largest) / static_cast<double>(n), 1e-12);
  EXPECT_EQ(s.loose, loose);
  EXPECT_EQ(s.first_layer, first_layer);
  EXPECT_EQ(s.held, held);
}

TEST(Diagnostics, AreTheSameBitsForAnyNumberOfThreads) {
  Sample sample;
  sample.position = random_points(9000, 3);
  sample.wall = random_points(100, 3);
  const Array<Real> mass(sample.position.size(), Real(0.7));
  const AllPairs fluid(sample.position, sample.position, {}, 0.2, true);
  const AllPairs walls(sample.position, sample.wall, {}, 0.2, false);
  const auto measured = [&](int threads) {
    omp_set_num_threads(threads);
    const Motion m = motion(sample.position, sample.position, mass, 1, {1, 2, -9.81});
    const Extent e = extent(sample.position, mass);
    const Structure s = structure({sample.position, sample.wall, fluid.rows(), walls.rows(), {}, sample.spacing, 0.2});
    return std::vector<double>{m.kinetic_energy,
                               m.potential_energy,
                               m.momentum.x,
                               m.max_speed,
                               e.radius_of_gyration,
                               e.farthest,
                               s.largest_share,
                               s.nearest_p5,
                               s.wetted_area,
                               double(s.pieces),
                               double(s.loose),
                               double(s.held),
                               compression(mass).average};
  };
  const int threads = omp_get_max_threads();
  const auto one = measured(1), two = measured(2), eight = measured(8);
  omp_set_num_threads(threads);
  EXPECT_EQ(one, two);
  EXPECT_EQ(one, eight);
}

}  // namespace
}  // namespace sessile
