#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/forces.h"

namespace sessile::becker2007_test {
namespace {

using test::acceleration;

constexpr double h = 0.2, dx = 0.1, rho0 = 1000, mass = 1;
constexpr double hand = sizeof(Real) == 4 ? 1e-5 : 1e-12;

double w(double q) { return q <= 0.5 ? 6 * q * q * q - 6 * q * q + 1 : q < 1 ? 2 * std::pow(1 - q, 3) : 0; }

TEST(Becker2007, ForceIsThePublishedOne) {
  for (const double r : {0.06, 0.1, 0.13, 0.17}) {
    const double W = 8 / (std::numbers::pi * h * h * h) * w(std::max(r, dx) / h);
    const Array3 a = acceleration(test::pair_of_particles(r), Becker2007{4});
    EXPECT_NEAR(static_cast<double>(a[0].x) / (4 * r * W), 1, hand) << r;
  }
}

TEST(Becker2007, HeavyNeighboursPullHarder) {
  test::Cloud cloud;
  cloud.add({0, 0, 0}, {}, 2);
  cloud.add({0.15, 0, 0}, {}, 0.5);
  cloud.look_around();
  const Array3 a = acceleration(cloud, Becker2007{});
  // a = kappa m_j/m_i x W: a_0/a_1 = -(0.5/2)/(2/0.5)
  EXPECT_NEAR(static_cast<double>(a[0].x / a[1].x), -1.0 / 16, 1e-6);
}

TEST(Becker2007, TensionIsTheIntegralOverThePairs) {
  for (const double support : {0.9, 1.5, 2.0, 3.0, 4.7}) {
    const double radius = support * dx;
    double integral = 0;  // (pi/8) n^2 int F r^4 dr with F = kappa m r W
    const int steps = 200000;
    for (int k = 0; k < steps; ++k) {
      const double r = (k + 0.5) * radius / steps;
      const double W = 8 / (std::numbers::pi * std::pow(radius, 3)) * w(std::max(r, dx) / radius);
      integral += 4 * mass * std::pow(r, 5) * W * radius / steps;
    }
    const double sigma = std::numbers::pi / 8 * std::pow(dx, -6) * integral;
    EXPECT_NEAR(Becker2007{4}.tension({dx, radius, rho0}), sigma, 1e-8 * (sigma + 1)) << support;
  }
}

}  // namespace
}  // namespace sessile::becker2007_test
