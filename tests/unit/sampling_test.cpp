#include "sessile/scene/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

#include "sessile/core/error.h"
#include "sessile/scene/read.h"

namespace sessile::test::of_sampling {
namespace {

constexpr double pi = std::numbers::pi;

Solid solid_of(const SolidShape& shape, int layers = 1) {
  Solid solid;
  solid.shape = shape;
  solid.layers = layers;
  return solid;
}

Body body_of(const BodyShape& shape) {
  Body body;
  body.shape = shape;
  return body;
}

/// The distance from each of some points to its nearest neighbour, the least and the greatest.
std::pair<double, double> nearest_distances(const std::vector<Vec3d>& points) {
  double least = 1e300, greatest = 0;
  const std::size_t stride = points.size() / 500 + 1;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    double nearest = 1e300;
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (j != i) nearest = std::min(nearest, length(points[j] - points[i]));
    }
    least = std::min(least, nearest);
    greatest = std::max(greatest, nearest);
  }
  return {least, greatest};
}

std::pair<Vec3d, Vec3d> bounds(const std::vector<Vec3d>& points) {
  Vec3d low = points.at(0), high = low;
  for (const auto& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return {low, high};
}

void expect_near(const Vec3d& a, const Vec3d& b, double error) {
  EXPECT_NEAR(a.x, b.x, error);
  EXPECT_NEAR(a.y, b.y, error);
  EXPECT_NEAR(a.z, b.z, error);
}

TEST(Placement, TurnsAndMoves) {
  const Placement placement{{1, 2, 3}, {0, 0, 5}, 90};
  EXPECT_EQ(placement.to_world({1, 0, 0}), (Vec3d{1, 3, 3}));  // exact at quarter turns
  EXPECT_EQ(placement.to_local({1, 3, 3}), (Vec3d{1, 0, 0}));
  EXPECT_EQ(placement.turn({0, 1, 0}), (Vec3d{-1, 0, 0}));
  const Placement skew{{1, 2, 3}, {1e-200, 2e-200, -1e-200}, 77};
  expect_near(skew.to_local(skew.to_world({0.3, 0.4, 0.5})), {0.3, 0.4, 0.5}, 1e-15);
  EXPECT_NEAR(length(skew.turn({0, 3, 4})), 5, 1e-14);
}

TEST(Fill, BoxIsAWholeLattice) {
  Body body = body_of(Box{{1.2, 1.2, 1.2}});
  body.placement.position = {0, 0, 1.05};
  const auto points = fill(body, 0.1);
  EXPECT_EQ(points.size(), 1728U);
  const auto [low, high] = bounds(points);
  expect_near(low, {-0.55, -0.55, 0.5}, 1e-14);
  expect_near(high, {0.55, 0.55, 1.6}, 1e-14);
  const auto [least, greatest] = nearest_distances(points);
  EXPECT_NEAR(least, 0.1, 1e-14);
  EXPECT_NEAR(greatest, 0.1, 1e-14);
}

TEST(Fill, HoldsTheVolumeOfItsShape) {
  const auto volume = [](const BodyShape& shape, double spacing) {
    return static_cast<double>(fill(body_of(shape), spacing).size()) * spacing * spacing * spacing;
  };
  EXPECT_NEAR(volume(Sphere{1}, 0.05), 4 * pi / 3, 0.02);
  EXPECT_NEAR(volume(Cylinder{1, 0.5}, 0.05), pi / 2, 0.02);
  EXPECT_NEAR(volume(Box{{0.5, 1, 1.5}}, 0.05), 0.75, 1e-12);
  EXPECT_NEAR(estimate_fill(body_of(Sphere{1}), 0.05) * 0.05 * 0.05 * 0.05, 4 * pi / 3, 1e-12);
}

TEST(Fill, JitterIsBoundedAndTheSameEachTime) {
  Body body = body_of(Box{{1, 1, 1}});
  const auto still = fill(body, 0.1);
  body.jitter = 0.25;
  const auto shaken = fill(body, 0.1);
  EXPECT_EQ(shaken, fill(body, 0.1));
  double most = 0, sum = 0;
  for (std::size_t i = 0; i < still.size(); ++i) {
    const Vec3d d = shaken[i] - still[i];
    most = std::max({most, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    sum += d.x + d.y + d.z;
  }
  EXPECT_LE(most, 0.025);
  EXPECT_GT(most, 0.024);
  EXPECT_LT(std::abs(sum) / 3000, 0.001);
  body.seed = 2;
  EXPECT_NE(shaken, fill(body, 0.1));
}

TEST(Fill, RefusesWhatItCannotHold) {
  const auto message = [](const Body& body, double spacing) -> std::string {
    try {
      fill(body, spacing);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  Body body = body_of(Box{{1, 1, 0.01}});
  EXPECT_EQ(message(body, 0.1), "body (box): is too small to hold a particle of spacing 0.1 m");
  body.label = "sea";
  EXPECT_EQ(message(body, 1e-6), "body \"sea\" (box): needs more than 2000000000 points at this spacing");
  body.shape = Box{{1e300, 1e300, 1e300}};
  EXPECT_EQ(message(body, 1e-6), "body \"sea\" (box): needs more than 2000000000 points at this spacing");
}

TEST(Layer, IsAFlatLattice) {
  Emitter emitter;
  emitter.shape = Rectangle{3.2, 3.2};
  emitter.placement = {{0, 0, 1.5}, {0, 0, 1}, 0};
  const auto points = layer(emitter, 0.1);
  EXPECT_EQ(points.size(), 1024U);
  const auto [low, high] = bounds(points);
  expect_near(low, {-1.55, -1.55, 1.5}, 1e-14);
  expect_near(high, {1.55, 1.55, 1.5}, 1e-14);
  emitter.shape = Disc{1};
  EXPECT_NEAR(static_cast<double>(layer(emitter, 0.02).size()) * 0.02 * 0.02, pi, 0.01);
}

TEST(Surface, BoxesOfTheBenchesHaveTheirSamples) {
  EXPECT_EQ(sample_surface(solid_of(Container{{8, 8, 8}}), 0.1).size(), 38402U);
  EXPECT_EQ(sample_surface(solid_of(Box{{4, 4, 0.2}}), 0.1).size(), 3522U);
  EXPECT_EQ(sample_surface(solid_of(Container{{12.6, 6.4, 9.6}}), 0.1).size(), 52610U);
  EXPECT_EQ(sample_surface(solid_of(Container{{20, 10.1, 15}}), 0.1).size(), 130702U);
  EXPECT_EQ(sample_surface(solid_of(Plate{7.2, 7.2}), 0.1).size(), 73U * 73U);
}

TEST(Surface, BenchScenesAreTheDocumentedOnes) {
  const Scene scene = read_scene(std::string(SESSILE_SCENES) + "/bench/s1.json");
  const auto [low, high] = bounds(fill(scene.bodies[0], scene.spacing));
  expect_near(low, {-1.55, -1.55, 2.3}, 1e-12);
  expect_near(high, {1.55, 1.55, 5.4}, 1e-12);
  const auto [board_low, board_high] = bounds(sample_surface(scene.solids[1], scene.spacing));
  expect_near(board_low, {-2, -2, 1.8}, 1e-12);
  expect_near(board_high, {2, 2, 2}, 1e-12);
  for (const char* name : {"/bench/s2_250k.json", "/bench/s2_1m.json"}) {
    const Scene dam = read_scene(SESSILE_SCENES + std::string(name));
    expect_near(bounds(fill(dam.bodies[0], dam.spacing)).first, {0.1, 0.1, 0.1}, 1e-12);
    expect_near(bounds(sample_surface(dam.solids[0], dam.spacing)).first, {0, 0, 0}, 1e-12);
  }
}

TEST(Surface, BoxSamplesAreDistinctAndOnTheFaces) {
  const auto samples = sample_surface(solid_of(Box{{1, 0.55, 0.1}}), 0.1);  // 0.55: 6 steps of 0.0917
  EXPECT_EQ(samples.size(), 11U * 7U * 2U);
  std::set<std::tuple<double, double, double>> places;
  for (const auto& p : samples) {
    places.emplace(p.x, p.y, p.z);
    EXPECT_NEAR(std::max({std::abs(p.x) / 0.5, std::abs(p.y) / 0.275, std::abs(p.z) / 0.05}), 1, 1e-12);
  }
  EXPECT_EQ(places.size(), samples.size());
}

TEST(Surface, LayersGrowIntoTheMatter) {
  EXPECT_EQ(sample_surface(solid_of(Box{{1, 1, 1}}, 2), 0.1).size(), 11U * 11U * 11U - 7U * 7U * 7U);
  EXPECT_EQ(sample_surface(solid_of(Box{{0.2, 0.2, 0.2}}, 8), 0.1).size(), 27U);
  const auto container = sample_surface(solid_of(Container{{1, 1, 1}}, 2), 0.1);
  EXPECT_EQ(container.size(), 13U * 13U * 13U - 9U * 9U * 9U);
  expect_near(bounds(container).second, {0.6, 0.6, 0.6}, 1e-12);
  const auto plate = sample_surface(solid_of(Plate{1, 1}, 3), 0.1);
  EXPECT_EQ(plate.size(), 3U * 121U);
  EXPECT_NEAR(bounds(plate).first.z, -0.2, 1e-15);
  EXPECT_EQ(bounds(plate).second.z, 0);
  for (const auto& p : sample_surface(solid_of(Sphere{1}, 3), 0.1)) {
    const double rest = std::remainder(length(p), 0.1);
    EXPECT_NEAR(rest, 0, 1e-12);
    EXPECT_GT(length(p), 0.75);
  }
  EXPECT_LT(sample_surface(solid_of(Cylinder{0.2, 0.2}, 8), 0.1).size(), 100U);
}

TEST(Surface, RoundShapesAreEven) {
  const auto even = [](const SolidShape& shape, double area) {
    const auto samples = sample_surface(solid_of(shape), 0.05);
    EXPECT_NEAR(static_cast<double>(samples.size()) * 0.05 * 0.05, area, 0.05 * area);
    EXPECT_NEAR(estimate_surface(solid_of(shape), 0.05), static_cast<double>(samples.size()),
                0.05 * static_cast<double>(samples.size()));
    const auto [least, greatest] = nearest_distances(samples);
    EXPECT_GT(least, 0.7 * 0.05);
    EXPECT_LT(greatest, 1.3 * 0.05);
  };
  even(Sphere{1}, 4 * pi);
  even(Cylinder{0.5, 2}, 2 * pi * 0.5 * 2.5);
}

// What memory is asked for: never too little, and not much too much.
TEST(Surface, IsEstimatedFromAbove) {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(random));
  };
  for (int turn = 0; turn < 300; ++turn) {
    const auto edge = [&] { return between(0.01, turn % 2 == 0 ? 1 : 5); };
    for (const SolidShape& shape : {SolidShape(Box{{edge(), edge(), edge()}}),
                                    SolidShape(Container{{edge(), edge(), edge()}}), SolidShape(Plate{edge(), edge()}),
                                    SolidShape(Sphere{edge() / 2}), SolidShape(Cylinder{edge() / 2, edge()})}) {
      Solid solid = solid_of(shape);
      solid.layers = 1 + turn % 8;
      const double estimate = estimate_surface(solid, 0.1);
      const auto samples = static_cast<double>(sample_surface(solid, 0.1).size());
      EXPECT_GE(estimate, samples) << "shape " << shape.index() << ", layers " << solid.layers;
      if (solid.layers == 1 && samples > 500) {
        EXPECT_LT(estimate, 1.2 * samples) << "shape " << shape.index();
      }
    }
  }
}

TEST(Surface, SpacingOfItsOwn) {
  Solid solid = solid_of(Plate{1, 1});
  solid.spacing = 0.05;
  EXPECT_EQ(sample_surface(solid, 0.1).size(), 21U * 21U);
}

TEST(Sampling, IsTheSameAtEveryScale) {
  for (const double scale : {1e-6, 1e4}) {
    const double s = scale;
    const auto count = [&](auto&& shape, double unit) {
      return sample_surface(solid_of(shape, 2), 0.07 * unit).size();
    };
    EXPECT_EQ(count(Box{{s, 2 * s, 3 * s}}, s), count(Box{{1, 2, 3}}, 1));
    EXPECT_EQ(count(Container{{s, 2 * s, 3 * s}}, s), count(Container{{1, 2, 3}}, 1));
    EXPECT_EQ(count(Sphere{s}, s), count(Sphere{1}, 1));
    EXPECT_EQ(count(Cylinder{s, 2 * s}, s), count(Cylinder{1, 2}, 1));
    EXPECT_EQ(fill(body_of(Sphere{s}), 0.07 * s).size(), fill(body_of(Sphere{1}), 0.07).size());
  }
}

TEST(DomainWalls, FaceInwards) {
  Domain domain{{-1, -2, -3}, {1, 2, 3}, Edge::closed, Edge::closed, Edge::closed};
  auto walls = domain_walls(domain);
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_EQ(walls[0].label, "domain");
  EXPECT_EQ(std::get<Container>(walls[0].shape).size, (Vec3d{2, 4, 6}));
  for (Edge* open : {&domain.x, &domain.y, &domain.z}) {
    domain.x = domain.y = domain.z = Edge::closed;
    *open = Edge::open;
    walls = domain_walls(domain);
    ASSERT_EQ(walls.size(), 4U);
    for (const auto& wall : walls) {
      // Its axis points to the centre, and its samples fill the face.
      EXPECT_LT(dot(wall.placement.turn({0, 0, 1}), wall.placement.position), 0) << wall.label;
      const auto [low, high] = bounds(sample_surface(wall, 0.1));
      const Vec3d size = high - low;
      EXPECT_NEAR(
          size.x * size.y + size.y * size.z + size.z * size.x,
          [&] {
            const char axis = wall.label[7];
            return axis == 'x' ? 24.0 : axis == 'y' ? 12.0 : 8.0;
          }(),
          1e-9)
          << wall.label;
      EXPECT_GE(low.x, -1 - 1e-12);
      EXPECT_GE(low.y, -2 - 1e-12);
      EXPECT_LE(high.z, 3 + 1e-12);
    }
  }
  domain.x = domain.y = domain.z = Edge::periodic;
  EXPECT_TRUE(domain_walls(domain).empty());
}

}  // namespace
}  // namespace sessile::test::of_sampling
