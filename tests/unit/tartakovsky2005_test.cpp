#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/forces.h"

namespace sessile::tartakovsky2005_test {
namespace {

using test::acceleration;

constexpr double h = 0.2, dx = 0.1, rho0 = 1000, mass = 1;
constexpr double hand = sizeof(Real) == 4 ? 1e-5 : 1e-12;

TEST(Tartakovsky2005, ForceIsThePublishedOne) {
  for (const double r : {0.03, 0.06, 0.07, 0.13, 0.19}) {
    const Array3 a = acceleration(test::pair_of_particles(r), Tartakovsky2005{3, 0});
    const double force = 3 * std::cos(1.5 * std::numbers::pi * r / h) * -1;  // x_01/r is -1
    EXPECT_NEAR(static_cast<double>(a[0].x) * mass, force, 3 * hand) << r;
  }
}

TEST(Tartakovsky2005, RepelsBelowAThirdOfTheSupport) {
  EXPECT_LT(acceleration(test::pair_of_particles(0.99 * h / 3), Tartakovsky2005{})[0].x, 0);
  EXPECT_GT(acceleration(test::pair_of_particles(1.01 * h / 3), Tartakovsky2005{})[0].x, 0);
}

TEST(Tartakovsky2005, ABoundaryParticleCountsByItsVolume) {
  const double r = 0.15;
  const Array3 a = acceleration(test::particle_above_wall(r), Tartakovsky2005{0, 3});
  EXPECT_NEAR(static_cast<double>(a[0].z) * mass / (3 * 1.43 * std::cos(1.5 * std::numbers::pi * r / h)), 1, hand);
}

TEST(Tartakovsky2005, UnequalMassesConserveMomentumToo) {
  test::Cloud cloud = test::lattice(9, 0.3);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) cloud.particles.mass[i] = i % 3 == 0 ? Real(2) : Real(0.7);
  cloud.look_around();
  EXPECT_LT(test::net_over_total(cloud, acceleration(cloud, Tartakovsky2005{})), test::antisymmetry);
}

TEST(Tartakovsky2005, GivesTheSolidTheOppositeForceAndTorque) {
  test::Cloud cloud = test::lattice(8, 0.3, true);
  cloud.look_around();
  test::expect_opposite_reaction(cloud, Tartakovsky2005{0, 5});
}

TEST(Tartakovsky2005, TensionIsTheIntegralOverThePairs) {
  for (const double support : {1.5, 2.0, 3.0}) {
    const double radius = support * dx;
    double integral = 0;
    const int steps = 200000;
    for (int k = 0; k < steps; ++k) {
      const double r = (k + 0.5) * radius / steps;
      integral -= 3 * std::cos(1.5 * std::numbers::pi * r / radius) * std::pow(r, 4) * radius / steps;
    }
    const double sigma = std::numbers::pi / 8 * std::pow(dx, -6) * integral;
    EXPECT_NEAR(Tartakovsky2005{3}.tension({dx, radius, rho0}), sigma, 1e-8 * sigma);
  }
}

}  // namespace
}  // namespace sessile::tartakovsky2005_test
