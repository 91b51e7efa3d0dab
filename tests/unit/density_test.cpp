#include "sessile/particles/density.h"

#include <gtest/gtest.h>

#include "support/cloud.h"

namespace sessile {
namespace {

TEST(Density, IsRestDensityInsideACubicLattice) {
  test::Cloud cloud = test::lattice(9, 0);
  cloud.look_around();
  double greatest = 0;
  for (std::size_t i = 0; i < cloud.density.size(); ++i) {
    const Vec3r x = cloud.particles.position[i];
    const bool interior = std::min({x.x, x.y, x.z}) > Real(0.25) && std::max({x.x, x.y, x.z}) < Real(0.55);
    if (!interior) continue;
    EXPECT_NEAR(cloud.density[i], 1, 1e-3);
    EXPECT_GE(cloud.near.count(i), 26);  // six more lie at the radius to rounding
    EXPECT_LE(cloud.near.count(i), 32);
    EXPECT_LT(length(cloud.normal[i]), 1e-4);
    greatest = std::max(greatest, static_cast<double>(cloud.density[i]));
  }
  EXPECT_GT(greatest, 0);
}

TEST(Density, CountsBoundaryParticles) {
  test::Cloud cloud = test::lattice(6, 0, true);
  cloud.look_around();
  test::Cloud bare = test::lattice(6, 0, false);
  bare.look_around();
  for (std::size_t i = 0; i < cloud.density.size(); ++i) {
    const Real more = cloud.density[i] - bare.density[i];
    if (cloud.particles.position[i].z < Real(0.05)) {
      EXPECT_GT(more, Real(0.1));
    } else if (cloud.particles.position[i].z > Real(0.15)) {
      EXPECT_EQ(more, 0);
    }
  }
}

TEST(Density, OfALonelyParticleIsItsOwn) {
  test::Cloud cloud;
  cloud.add({5, 5, 5}, {}, 0.8);
  cloud.look_around();
  EXPECT_FLOAT_EQ(static_cast<float>(cloud.density[0]), 0.8f * static_cast<float>(cloud.view().W.at_zero()));
  EXPECT_EQ(cloud.normal[0], Vec3r{});
}

TEST(Normals, PointInwardAtTheSurface) {
  test::Cloud cloud = test::lattice(8, 0);
  cloud.look_around();
  for (std::size_t i = 0; i < cloud.density.size(); ++i) {
    const Real height = cloud.particles.position[i].z;
    if (height < Real(0.05)) {
      EXPECT_GT(cloud.normal[i].z, Real(0.1));
    }
    if (height > Real(0.65)) {
      EXPECT_LT(cloud.normal[i].z, Real(-0.1));
    }
  }
}

}  // namespace
}  // namespace sessile
