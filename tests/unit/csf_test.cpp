#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/forces.h"

namespace sessile::csf_test {
namespace {

using test::acceleration;

constexpr double h = 0.2, dx = 0.1, rho0 = 1000, mass = 1;
constexpr double hand = sizeof(Real) == 4 ? 1e-5 : 1e-12;

TEST(Csf, ForceIsThePublishedOne) {
  const double r = 0.07, W0 = 8 / (std::numbers::pi * h * h * h), q = r / h;
  const double V = 1 / (W0 * (1 + 6 * q * q * q - 6 * q * q + 1));
  const double slope = W0 / h * (18 * q * q - 12 * q), curve = W0 / (h * h) * (36 * q - 12);
  const double laplacian = V * (-36 * W0 / (h * h) + curve + 2 * slope / r);
  // The normal of the left one points right, to where there is more liquid.
  const Array3 a = acceleration(test::pair_of_particles(r), Csf{72, 0});
  EXPECT_NEAR(static_cast<double>(a[0].x) / (-72 * V / mass * laplacian), 1, hand);
  EXPECT_EQ(a[1].x, -a[0].x);
}

TEST(Csf, ActsWhereTheNormalIsLongAlone) {
  const test::Cloud cloud = test::ball(8);
  const Array3 all = acceleration(cloud, Csf{72, 0}), some = acceleration(cloud, Csf{72, 0.5});
  int surface = 0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const bool long_enough = length(cloud.normal[i]) > Real(0.5);
    EXPECT_EQ(some[i], long_enough ? all[i] : Vec3r{});
    surface += long_enough;
  }
  // The default: the outermost layer of a ball, whose normals are above 0.6, and not the second, below 0.3.
  for (std::size_t i = 0; i < some.size(); ++i) {
    const double depth = 8 - static_cast<double>(length(cloud.particles.position[i])) / dx;
    const Real n = length(cloud.normal[i]);
    EXPECT_TRUE(depth < 1 || n < Real(0.3)) << depth;
    EXPECT_TRUE(n < Real(0.3) || n > Real(0.6)) << n;
  }
  EXPECT_GT(surface, 500);
}

TEST(Csf, PullsABallTogether) {
  // The publication's force is sigma (2/R) |n| / rho. Sampled from the liquid's side alone, the Laplacian overrates the
  // curvature: at R = 5 dx four to eleven times.
  const double R = 5;
  const test::Cloud cloud = test::ball(R);
  const Array3 a = acceleration(cloud, Csf{72, 0.5});
  int surface = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == Vec3r{}) continue;
    const Vec3d x = vec_cast<double>(cloud.particles.position[i]);
    const double inward = -dot(vec_cast<double>(a[i]), x) / length(x);
    const double n = static_cast<double>(length(cloud.normal[i])) / h;
    const double ideal = 72 * 2 / (R * dx) * n / (rho0 * static_cast<double>(cloud.density[i]));
    EXPECT_GT(inward, 4 * ideal) << n;
    EXPECT_LT(inward, 11 * ideal) << n;
    ++surface;
  }
  EXPECT_GT(surface, 100);
}

TEST(Csf, PressesAFlatSurfaceToo) {
  // The continuum has no force on a plane. On a cubic lattice's face, one-sided: see the docstring.
  test::Cloud cube = test::lattice(14, 0);
  cube.look_around();
  const Array3 a = acceleration(cube, Csf{72, 0.5});
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3d x = vec_cast<double>(cube.particles.position[i]);
    if (length(x - Vec3d{0.6, 0.6, 0}) > 0.01) continue;
    EXPECT_NEAR(static_cast<double>(cube.normal[i].z), 1.02, 0.01);
    EXPECT_NEAR(static_cast<double>(a[i].z) / (72 / (rho0 * h * h)), 8, 1);
  }
}

}  // namespace
}  // namespace sessile::csf_test
