#include <gtest/gtest.h>

#include <random>

#include "sessile/pressure/pressure_force.h"
#include "sessile/pressure/solve.h"
#include "support/cloud.h"
#include "support/scenes.h"

namespace sessile {
namespace {

constexpr double dt = 0.002;
constexpr double rounding = sizeof(Real) == 4 ? 1e-5 : 1e-12;

/// A random block that falls on to a floor and against a wall, of unequal masses.
test::Cloud in_a_corner() {
  test::Cloud cloud = test::lattice(8, 0.1, true);
  for (int a = -3; a < 11; ++a) {
    for (int b = 0; b < 11; ++b) cloud.add_wall({-0.1, 0.1 * a, 0.1 * b});
  }
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
    cloud.particles.mass[i] = i % 2 == 0 ? Real(1.05) : Real(0.95);
    cloud.particles.velocity.set(i, cloud.particles.velocity[i] + Vec3r{Real(-1), 0, Real(-2)});
  }
  cloud.look_around();
  return cloud;
}

struct Solved {
  PressureResult result;
  Array<Real> pressure;
  PressureScratch scratch;
};

Solved solved(const test::Cloud& cloud, Iteration iteration, double error, int most = 4000, int least = 2,
              Real start = 0) {
  Iisph method;
  method.iteration = iteration;
  method.error = error;
  method.min_iterations = least;
  method.max_iterations = most;
  Solved s;
  s.pressure.assign(cloud.particles.size(), start);
  s.result = solve(method, cloud.view(), cloud.particles.velocity, dt, s.pressure, s.scratch);
  return s;
}

/// Density over rest density that a solve's acceleration leads to.
Array<Real> predicted(const test::Cloud& cloud, const Solved& s) {
  Array<Real> change;
  density_change(cloud.view(), s.scratch.acceleration, dt, change);
  for (std::size_t i = 0; i < change.size(); ++i) change[i] += s.scratch.advected[i];
  return change;
}

// <x, A y> = <A x, y> with s = p/rho^2 and the masses as weights, and <x, A x> = dt^2 sum m |a|^2: what the method
// rests on, with walls and unequal masses.
TEST(Conjugate, WhatPressureTakesFromDensitiesIsSymmetricAndPositive) {
  const test::Cloud cloud = in_a_corner();
  const StepView s = cloud.view();
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> any(0, 10);
  Array<Real> x(s.n), y(s.n), stress, by_x, by_y;
  for (std::size_t i = 0; i < s.n; ++i) x[i] = any(random), y[i] = any(random);
  Array3 a_of_x, a_of_y;
  pressure_acceleration(s, x, stress, a_of_x);
  pressure_acceleration(s, y, stress, a_of_y);
  density_change(s, a_of_x, dt, by_x);
  density_change(s, a_of_y, dt, by_y);
  double xy = 0, yx = 0, xx = 0, squares = 0;
  for (std::size_t i = 0; i < s.n; ++i) {
    const double m = static_cast<double>(s.m[static_cast<int>(i)]), rho = static_cast<double>(cloud.density[i]);
    const double weight = m / (rho * rho);
    xy += weight * static_cast<double>(x[i]) * static_cast<double>(by_y[i]);
    yx += weight * static_cast<double>(y[i]) * static_cast<double>(by_x[i]);
    xx -= weight * static_cast<double>(x[i]) * static_cast<double>(by_x[i]);
    squares += dt * dt * m * squared_length(vec_cast<double>(a_of_x[i]));
  }
  EXPECT_LT(xy, 0);
  EXPECT_NEAR(xy / yx, 1, rounding);
  EXPECT_NEAR(xx / squares, 1, rounding);
}

TEST(Conjugate, ReachesWhatManyJacobiStepsReach) {
  const test::Cloud cloud = in_a_corner();
  const Solved jacobi = solved(cloud, Iteration::jacobi, 1e-7), conjugate = solved(cloud, Iteration::conjugate, 1e-7);
  EXPECT_TRUE(jacobi.result.converged);
  EXPECT_TRUE(conjugate.result.converged);
  EXPECT_LT(test::difference(jacobi.scratch.acceleration, conjugate.scratch.acceleration), 5e-3);
  EXPECT_LT(3 * conjugate.result.iterations, jacobi.result.iterations);
  std::printf("to 1e-7: %d turns, Jacobi %d\n", conjugate.result.iterations, jacobi.result.iterations);
}

// The solution of the problem with p >= 0: no density above rest, and rest density where there is pressure.
TEST(Conjugate, LeavesRestDensityWhereThereIsPressure) {
  const test::Cloud cloud = in_a_corner();
  const Solved s = solved(cloud, Iteration::conjugate, 1e-7, 200, 60);
  const Array<Real> density = predicted(cloud, s);
  int pressed = 0, free = 0;
  for (std::size_t i = 0; i < density.size(); ++i) {
    EXPECT_GE(s.pressure[i], 0);
    EXPECT_LT(density[i], 1 + Real(2e-5));
    if (s.pressure[i] > Real(0.05)) {
      EXPECT_NEAR(density[i], 1, 2e-5);
      ++pressed;
    } else {
      ++free;
    }
  }
  EXPECT_GT(pressed, 50);
  EXPECT_GT(free, 50);
}

// Acceleration and residual are carried along; they stay those of the pressures handed back.
TEST(Conjugate, WhatItCarriesIsWhatThePressuresGive) {
  const test::Cloud cloud = in_a_corner();
  for (const int turns : {1, 2, 5, 40}) {
    const Solved s = solved(cloud, Iteration::conjugate, 1e-9, turns, turns);
    Array<Real> stress;
    Array3 a;
    pressure_acceleration(cloud.view(), s.pressure, stress, a);
    if (turns > 1) {
      EXPECT_LT(test::difference(a, s.scratch.acceleration), rounding) << turns;
    }
    EXPECT_EQ(stress, s.scratch.stress);
    const Array<Real> density = predicted(cloud, s);
    double left = 0;
    for (std::size_t i = 0; i < density.size(); ++i) {
      EXPECT_NEAR(density[i] - 1, s.scratch.residual[i], 1e-6) << turns;
      left += std::max(0.0, static_cast<double>(density[i]) - 1);
    }
    EXPECT_NEAR(left / static_cast<double>(density.size()), s.result.error, 1e-7) << turns;
  }
}

// Too much liquid for a space without an edge: no pressure can mend it, and rounding must not be taken for a push.
TEST(Conjugate, LeavesAloneWhatNoPressureCanMend) {
  test::Cloud cloud = test::lattice(6, 0);
  const auto edge = Real(0.6);
  cloud.space = Space{{edge, edge, edge}, {1 / edge, 1 / edge, 1 / edge}, true};
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
    cloud.particles.mass[i] = Real(1.05);
    cloud.particles.velocity.set(i, {});
  }
  cloud.look_around();
  for (const Real start : {Real(0), Real(1)}) {
    const Solved s = solved(cloud, Iteration::conjugate, 1e-4, 50, 2, start);
    EXPECT_FALSE(s.result.converged);
    EXPECT_GT(s.result.error, 0.01);
    for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
      EXPECT_LT(dt * dt * std::sqrt(squared_length(vec_cast<double>(s.scratch.acceleration[i]))), 1e-3 * 0.1);
    }
  }
}

TEST(Conjugate, EveryTurnTakesKineticEnergyOut) {
  const test::Cloud cloud = in_a_corner();
  double before = 1e30;
  for (int turns = 1; turns < 12; ++turns) {
    const Solved s = solved(cloud, Iteration::conjugate, 1e-9, turns, turns);
    // f(s) = <s, A s>/2 - <s, rho_adv - rho0>
    double f = 0;
    for (std::size_t i = 0; i < s.pressure.size(); ++i) {
      const double m = static_cast<double>(cloud.particles.mass[i]), rho = static_cast<double>(cloud.density[i]);
      f += 0.5 * dt * dt * m * squared_length(vec_cast<double>(s.scratch.acceleration[i])) -
           m / (rho * rho) * static_cast<double>(s.pressure[i]) * (static_cast<double>(s.scratch.advected[i]) - 1);
    }
    EXPECT_LT(f, turns == 1 ? 1e-12 : before) << turns;
    before = f;
  }
}

TEST(Conjugate, EndsAtOnceWhereNothingIsCompressed) {
  test::Cloud cloud = test::lattice(6, 0);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
    cloud.particles.mass[i] = Real(0.8);
    cloud.particles.velocity.set(i, {});
  }
  cloud.look_around();
  const Solved s = solved(cloud, Iteration::conjugate, 1e-4);
  EXPECT_TRUE(s.result.converged);
  EXPECT_EQ(s.result.iterations, 1);
  EXPECT_EQ(s.result.error, 0);
}

}  // namespace
}  // namespace sessile
