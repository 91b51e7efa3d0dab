#include <gtest/gtest.h>

#include "sessile/pressure/pressure_force.h"
#include "sessile/pressure/solve.h"
#include "support/cloud.h"

namespace sessile::iisph_test {
namespace {

constexpr double dt = 0.002;

/// Density that a pressure field takes from every particle: the linear map A of (29), (30).
Array<Real> density_change(const test::Cloud& cloud, const Array<Real>& pressure) {
  Array<Real> stress, change;
  Array3 a;
  pressure_acceleration(cloud.view(), pressure, stress, a);
  density_change(cloud.view(), a, dt, change);
  return change;
}

/// a_ii against the derivative of the residual by p_i. A is linear, so a difference of any size is exact.
void check_diagonal(test::Cloud cloud) {
  cloud.look_around();
  PressureScratch scratch;
  pressure_coefficients(cloud.view(), cloud.particles.velocity, dt, scratch);
  Array<Real> base(cloud.particles.size());
  for (std::size_t i = 0; i < base.size(); ++i) base[i] = Real(0.1) * Real(i % 5);
  const Array<Real> before = density_change(cloud, base);
  for (std::size_t i = 0; i < cloud.particles.size(); i += 17) {
    Array<Real> more = base;
    const Real step = 64;  // large beside the base, so that float rounding of the difference is small
    more[i] += step;
    const Array<Real> after = density_change(cloud, more);
    const double derivative = static_cast<double>((after[i] - before[i]) / step);
    EXPECT_LT(derivative, 0);
    EXPECT_NEAR(static_cast<double>(scratch.diagonal[i]) / derivative, 1, 1e-4) << "particle " << i;
  }
}

TEST(Iisph, DiagonalIsTheDerivativeInsideAndAtTheSurface) { check_diagonal(test::lattice(7, 0.25)); }

TEST(Iisph, DiagonalIsTheDerivativeAtAWall) { check_diagonal(test::lattice(6, 0.25, true)); }

TEST(Iisph, DiagonalIsTheDerivativeInACorner) {
  test::Cloud cloud = test::lattice(6, 0.25, true);
  for (int a = -3; a < 9; ++a) {
    for (int b = 0; b < 9; ++b) {
      cloud.add_wall({-0.1, 0.1 * a, 0.1 * b});
      cloud.add_wall({0.1 * a, -0.1, 0.1 * b});
    }
  }
  check_diagonal(std::move(cloud));
}

TEST(Iisph, DiagonalIsTheDerivativeForUnequalMasses) {
  test::Cloud cloud = test::lattice(6, 0.25, true);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) cloud.particles.mass[i] = i % 2 == 0 ? Real(1.5) : Real(0.8);
  check_diagonal(std::move(cloud));
}

TEST(Iisph, DiagonalOfACubicLatticeIsTheTabledOne) {
  // docs/model.md: a_ii/dt^2 = -42.5 at dx = 0.1 m (times rho0 / rho0, as pressures are over rho0 here: -42.5 * 1000
  // kg/m^3 per Pa becomes -42.5 per m^2/s^2 over rho0).
  test::Cloud cloud = test::lattice(9, 0);
  cloud.look_around();
  PressureScratch scratch;
  pressure_coefficients(cloud.view(), cloud.particles.velocity, 1, scratch);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
    const Vec3r x = cloud.particles.position[i];
    if (std::min({x.x, x.y, x.z}) < Real(0.25) || std::max({x.x, x.y, x.z}) > Real(0.55)) continue;
    EXPECT_NEAR(scratch.diagonal[i], -42.5, 0.2);
  }
}

TEST(Iisph, AdvectedDensityIsTheFirstOrderPrediction) {
  test::Cloud cloud = test::lattice(7, 0.2, true);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) {  // a slow squeeze
    const Vec3r x = cloud.particles.position[i];
    cloud.particles.velocity.set(i, {Real(-0.1) * x.x, Real(-0.1) * x.y, Real(0.05) * x.z});
  }
  cloud.look_around();
  PressureScratch scratch;
  pressure_coefficients(cloud.view(), cloud.particles.velocity, 1e-2, scratch);
  test::Cloud moved = cloud;
  for (std::size_t i = 0; i < moved.particles.size(); ++i) {
    moved.particles.position.set(i, cloud.particles.position[i] + Real(1e-2) * cloud.particles.velocity[i]);
  }
  const auto ids = cloud.particles.id;
  moved.look_around();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    for (std::size_t j = 0; j < ids.size(); ++j) {
      if (moved.particles.id[j] != ids[i]) continue;
      EXPECT_NEAR(moved.density[j], scratch.advected[i], 2e-5);
    }
  }
}

TEST(Iisph, DensityAtThePredictedPositionsIsThere) {
  test::Cloud cloud = test::lattice(7, 0.2, true);
  const Real step = Real(2e-3);
  cloud.look_around();
  PressureScratch scratch;
  pressure_coefficients(cloud.view(), cloud.particles.velocity, 2e-3, scratch);
  const Array<Real> linear = scratch.advected;
  advect_density_to_positions(cloud.view(), cloud.particles.velocity, 2e-3, scratch);
  test::Cloud moved = cloud;  // with the old neighbours: a pair that comes into reach adds next to nothing
  for (std::size_t i = 0; i < moved.particles.size(); ++i) {
    moved.particles.position.set(i, cloud.particles.position[i] + step * cloud.particles.velocity[i]);
  }
  moved.pair_positions();
  Array<Real> there;
  compute_density(moved.view(), there);
  double apart = 0;
  for (std::size_t i = 0; i < there.size(); ++i) {
    EXPECT_NEAR(scratch.advected[i], there[i], 1e-6);
    apart = std::max(apart, static_cast<double>(std::abs(linear[i] - there[i])));
  }
  EXPECT_GT(apart, 1e-5) << "else there is nothing to correct";
}

TEST(Iisph, DensityAtThePredictedPositionsIsTrustedWithinTwoPerCent) {
  test::Cloud cloud = test::lattice(6, 0, true);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) cloud.particles.velocity.set(i, {0, 0, Real(-30)});
  cloud.look_around();
  PressureScratch scratch;
  pressure_coefficients(cloud.view(), cloud.particles.velocity, 2e-3, scratch);
  const Array<Real> linear = scratch.advected;
  advect_density_to_positions(cloud.view(), cloud.particles.velocity, 2e-3, scratch);
  double greatest = 0;
  for (std::size_t i = 0; i < linear.size(); ++i) {
    greatest = std::max(greatest, static_cast<double>(std::abs(scratch.advected[i] - linear[i])));
  }
  EXPECT_NEAR(greatest, 0.02, 1e-6);
}

TEST(Iisph, TakesTheCompressionOutAndReportsWhatIsLeft) {
  test::Cloud cloud = test::lattice(8, 0.05, true);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) cloud.particles.velocity.set(i, {0, 0, Real(-1)});
  cloud.look_around();
  Array<Real> pressure(cloud.particles.size(), Real(0));
  PressureScratch scratch;
  Iisph method;
  const PressureResult result = solve(method, cloud.view(), cloud.particles.velocity, dt, pressure, scratch);
  EXPECT_TRUE(result.converged);
  EXPECT_LE(result.error, 1e-4);
  EXPECT_GE(result.iterations, 2);
  // What it reports is what its acceleration does.
  Array<Real> change;
  density_change(cloud.view(), scratch.acceleration, dt, change);
  double left = 0;
  for (std::size_t i = 0; i < change.size(); ++i) {
    left += std::max(0.0, static_cast<double>(scratch.advected[i]) + static_cast<double>(change[i]) - 1);
    EXPECT_GE(pressure[i], 0);
  }
  EXPECT_NEAR(left / static_cast<double>(change.size()), result.error, 1e-7);
}

TEST(Iisph, MomentumTakesFewerIterationsToTheSamePressures) {
  test::Cloud cloud = test::lattice(8, 0.05, true);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) cloud.particles.velocity.set(i, {0, 0, Real(-1)});
  cloud.look_around();
  const auto solved = [&](double momentum, int& iterations) {
    Array<Real> pressure(cloud.particles.size(), Real(0));
    PressureScratch scratch;
    Iisph method;
    method.error = 1e-6;
    method.iteration = Iteration::jacobi;
    method.momentum = momentum;
    iterations = solve(method, cloud.view(), cloud.particles.velocity, dt, pressure, scratch).iterations;
    return scratch.acceleration;
  };
  int printed = 0, with_momentum = 0;
  const Array3 a = solved(0, printed), b = solved(0.3, with_momentum);
  EXPECT_LT(with_momentum, 0.8 * printed);
  EXPECT_LT(test::difference(a, b), 0.02);
}

TEST(Iisph, SaysSoWhenItStopsShort) {
  test::Cloud cloud = test::lattice(8, 0.05, true);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) cloud.particles.velocity.set(i, {0, 0, Real(-5)});
  cloud.look_around();
  Array<Real> pressure(cloud.particles.size(), Real(0));
  PressureScratch scratch;
  Iisph method;
  method.max_iterations = 3;
  const PressureResult result = solve(method, cloud.view(), cloud.particles.velocity, 0.01, pressure, scratch);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 3);
  EXPECT_GT(result.error, 1e-4);
}

TEST(Iisph, ALonelyParticleHasNoPressure) {
  test::Cloud cloud;
  cloud.add({0, 0, 0}, {1, 2, 3});
  cloud.look_around();
  Array<Real> pressure{Real(7)};
  PressureScratch scratch;
  const PressureResult result = solve(Iisph{}, cloud.view(), cloud.particles.velocity, dt, pressure, scratch);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(pressure[0], 0);
  EXPECT_EQ(scratch.acceleration[0], Vec3r{});
}

}  // namespace
}  // namespace sessile::iisph_test
