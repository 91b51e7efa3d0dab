#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/forces.h"

namespace sessile {
namespace {

using test::acceleration;

constexpr double h = 0.2, dx = 0.1, rho0 = 1000, mass = 1;
constexpr double hand = sizeof(Real) == 4 ? 1e-5 : 1e-12;

TEST(Akinci2013, TensionIsThePublishedOne) {
  const double r = 0.15;
  const test::Cloud cloud = test::pair_of_particles(r);
  const double rho = rho0 * static_cast<double>(cloud.density[0]), K = rho0 / rho;
  const double C = 32 / (std::numbers::pi * std::pow(h, 9)) * std::pow(h - r, 3) * std::pow(r, 3);
  const double slope = 8 / (std::numbers::pi * std::pow(h, 4)) * -6 * std::pow(1 - r / h, 2);
  const double n0 = -h * mass / rho * slope;  // n_1 = -n_0
  const Array3 a = acceleration(cloud, Akinci2013{3, 0});
  EXPECT_NEAR(static_cast<double>(a[0].x) / (3 * K * (mass * C - 2 * n0)), 1, hand);
}

TEST(Akinci2013, AdhesionIsThePublishedOne) {
  const double r = 0.15;
  const double A = 0.007 / std::pow(h, 3.25) * std::pow(-4 * r * r / h + 6 * r - 2 * h, 0.25);
  const double psi = rho0 * 1.43 * dx * dx * dx;
  const Array3 a = acceleration(test::particle_above_wall(r), Akinci2013{0, 5});
  EXPECT_NEAR(static_cast<double>(a[0].z) / (-5 * psi * A), 1, hand);
}

TEST(Akinci2013, IsThePapersModelWhereThePairFactorsAgree) {
  test::Cloud cloud = test::lattice(8, 0.3);
  cloud.look_around();
  for (Real& rho : cloud.density) rho = 1;  // then K = 1 in both
  const Array3 a = acceleration(cloud, Akinci2013{2, 0});
  EXPECT_LT(test::difference(a, acceleration(cloud, SurfaceFeature{2, 2, 0, Direction::unit})), test::rounding);
}

TEST(Akinci2013, ForUnequalMassesOnlyCohesionConservesMomentum) {
  test::Cloud cloud = test::lattice(9, 0.3);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) cloud.particles.mass[i] = i % 3 == 0 ? Real(2) : Real(0.7);
  cloud.look_around();
  EXPECT_GT(test::net_over_total(cloud, acceleration(cloud, Akinci2013{1, 0})), 1e-4) << "as published";
  cloud.normal.assign(cloud.particles.size(), {});
  EXPECT_LT(test::net_over_total(cloud, acceleration(cloud, Akinci2013{1, 0})), test::antisymmetry);
}

TEST(Akinci2013, GivesTheSolidTheOppositeForceAndTorque) {
  test::Cloud cloud = test::lattice(8, 0.3, true);
  cloud.look_around();
  test::expect_opposite_reaction(cloud, Akinci2013{0, 5});
}

}  // namespace
}  // namespace sessile
