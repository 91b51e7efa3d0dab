#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sessile/core/error.h"
#include "sessile/pressure/pressure_force.h"
#include "sessile/pressure/solve.h"
#include "support/cloud.h"
#include "support/scenes.h"

namespace sessile::pressure_solvers_test {
namespace {

constexpr double dt = 0.002;
constexpr double rounding = sizeof(Real) == 4 ? 2e-4 : 1e-11;

struct Solved {
  PressureResult result;
  Array<Real> pressure;
  PressureScratch scratch;
};

Solved solved(const Pressure& method, const test::Cloud& cloud, bool one_lane = false) {
  Solved s;
  s.pressure.assign(cloud.particles.size(), 0);
  s.result = solve(method, cloud.view(one_lane), cloud.particles.velocity, dt, s.pressure, s.scratch);
  return s;
}

/// Average compression at the positions that a solve leads to, with new neighbours.
double real_error(const test::Cloud& cloud, const Solved& s) {
  test::Cloud moved = cloud;
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
    const Vec3r v = cloud.particles.velocity[i] + static_cast<Real>(dt) * s.scratch.acceleration[i];
    moved.particles.position.set(i, cloud.particles.position[i] + static_cast<Real>(dt) * v);
  }
  moved.look_around();
  double sum = 0;
  for (const Real rho : moved.density) sum += std::max(0.0, static_cast<double>(rho) - 1);
  return sum / static_cast<double>(moved.density.size());
}

std::vector<Pressure> every_solver() {
  Wcsph wcsph;
  wcsph.sound_speed = 40;
  Iisph jacobi;
  jacobi.iteration = Iteration::jacobi;
  return {Iisph{}, jacobi, Pcisph{}, wcsph, Dfsph{}};
}
std::string name_of(const Pressure& method) {
  return std::visit([](const auto& chosen) { return std::string(chosen.name); }, method);
}

static_assert(std::variant_size_v<Pressure> == 4, "a new solver belongs into every_solver()");

TEST(EverySolver, LanesAgreeWithOneLane) {
  const test::Cloud cloud = test::falling_block(1);
  for (const Pressure& method : every_solver()) {
    const Solved lanes = solved(method, cloud), one = solved(method, cloud, true);
    EXPECT_LT(test::difference(lanes.scratch.acceleration, one.scratch.acceleration), rounding) << name_of(method);
  }
}

TEST(EverySolver, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const Pressure& method : every_solver()) {
    const auto state = [&](int threads) {
      Particles end;
      test::with_threads(threads, [&] {
        Scene scene = test::column(10, 10, 1e-3);
        scene.pressure = method;
        scene.forces = {SurfaceFeature{}};
        scene.bodies[0].velocity = {0.3, 0.1, -2};
        Simulation simulation(scene);
        for (int k = 0; k < 8; ++k) simulation.step();
        end = simulation.particles();
      });
      return end;
    };
    const Particles one = state(1);
    for (const int threads : {2, 8}) {
      const Particles many = state(threads);
      EXPECT_EQ(one.position.z, many.position.z) << name_of(method) << ", " << threads;
      EXPECT_EQ(one.velocity.x, many.velocity.x) << name_of(method);
      EXPECT_EQ(one.pressure, many.pressure) << name_of(method);
      EXPECT_EQ(one.mean_pressure, many.mean_pressure) << name_of(method);
      EXPECT_EQ(one.divergence_pressure, many.divergence_pressure) << name_of(method);
    }
  }
}

TEST(EverySolver, PressureNeverPulls) {
  const test::Cloud cloud = test::falling_block(1);
  for (const Pressure& method : every_solver()) {
    const Solved s = solved(method, cloud);
    EXPECT_GE(*std::min_element(s.pressure.begin(), s.pressure.end()), 0) << name_of(method);
    EXPECT_GT(*std::max_element(s.pressure.begin(), s.pressure.end()), 0) << name_of(method);
    Array<Real> stress;  // the acceleration is that of the pressures handed back
    Array3 a;
    pressure_acceleration(cloud.view(), s.pressure, stress, a);
    // To rounding: conjugate directions carry it along with the pressures.
    EXPECT_LT(test::difference(a, s.scratch.acceleration), 2e-6) << name_of(method);
  }
}

TEST(EverySolver, RunsWithoutParticles) {
  for (const Pressure& method : every_solver()) {
    const Solved s = solved(method, {});
    EXPECT_TRUE(s.result.converged) << name_of(method);
    EXPECT_EQ(s.result.error, 0) << name_of(method);
  }
}

TEST(EverySolver, ThatIteratesTakesTheCompressionOut) {
  const test::Cloud cloud = test::falling_block(1);
  Solved nothing;
  nothing.scratch.acceleration.assign(cloud.particles.size(), {});
  const double without = real_error(cloud, nothing);
  for (const Pressure& method : every_solver()) {
    if (std::holds_alternative<Wcsph>(method)) continue;
    const Solved s = solved(method, cloud);
    EXPECT_TRUE(s.result.converged) << name_of(method);
    EXPECT_LE(s.result.error, 1e-4) << name_of(method);
    EXPECT_GT(s.result.iterations, 3) << name_of(method);
    // IISPH and DFSPH predict densities to first order in the step; the rest is left.
    EXPECT_LT(real_error(cloud, s), 0.2 * without) << name_of(method);
  }
}

// A lattice that is squeezed alike everywhere: the first correction inside is delta times the compression, with
// delta = 1/(2 dt^2 sum |grad W|^2) and sum |grad W|^2 = 42.5 / m^2 of the cubic lattice (docs/model.md).
TEST(Pcisph, FirstCorrectionIsDeltaTimesTheCompression) {
  test::Cloud cloud = test::lattice(11, 0);
  const Real squeeze = Real(0.99);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
    cloud.particles.position.set(i, squeeze * cloud.particles.position[i]);
    cloud.particles.velocity.set(i, {});
  }
  cloud.look_around();
  Pcisph method;
  method.max_iterations = 2;  // measures, corrects, measures
  const Solved s = solved(method, cloud);
  const double middle = 0.5 * 0.99;
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
    if (length(vec_cast<double>(cloud.particles.position[i]) - Vec3d{middle, middle, middle}) > 0.05) continue;
    const double compression = static_cast<double>(cloud.density[i]) - 1;
    EXPECT_GT(compression, 0.02);
    EXPECT_NEAR(static_cast<double>(s.pressure[i]) / (compression / (2 * dt * dt * 42.5)), 1, 5e-3);
  }
}

TEST(Pcisph, ItsErrorIsThatAtThePredictedPositions) {
  const test::Cloud cloud = test::falling_block(1);
  const Solved s = solved(Pcisph{}, cloud);
  // Neighbours that come into reach within the step are all it misses: their W is next to nothing.
  EXPECT_NEAR(s.result.error, real_error(cloud, s), 2e-6);
}

TEST(Pcisph, LighterParticlesGetTheSamePressure) {
  // Particles of 0.8 mass at rest density stand 0.8^(1/3) apart: the prototype must shrink with them.
  const auto pressure = [](double mass) {
    test::Cloud cloud = test::lattice(11, 0);
    const double squeeze = 0.99 * std::cbrt(mass), middle = 0.5 * squeeze;
    for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
      cloud.particles.position.set(i, static_cast<Real>(squeeze) * cloud.particles.position[i]);
      cloud.particles.velocity.set(i, {});
      cloud.particles.mass[i] = static_cast<Real>(mass);
    }
    cloud.look_around();
    const Solved s = solved(Pcisph{1e-4, 3, 200}, cloud);
    EXPECT_TRUE(s.result.converged);
    for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
      if (length(vec_cast<double>(cloud.particles.position[i]) - Vec3d{middle, middle, middle}) < 0.05) {
        return static_cast<double>(s.pressure[i]);
      }
    }
    return 0.0;
  };
  EXPECT_NEAR(pressure(0.8) / pressure(1), 1, 0.35);
}

TEST(Wcsph, PressureIsTaits) {
  const test::Cloud cloud = test::falling_block(1);
  Wcsph method;
  method.sound_speed = 30;
  method.gamma = 7;
  const Solved s = solved(method, cloud);
  int compressed = 0;
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
    const auto rho = static_cast<double>(cloud.density[i]);
    const double tait = 30.0 * 30 / 7 * (std::pow(rho, 7) - 1);
    EXPECT_NEAR(static_cast<double>(s.pressure[i]), std::max(0.0, tait), 1e-3);
    compressed += tait > 0;
  }
  EXPECT_GT(compressed, 10);
}

TEST(Wcsph, SpeedOfSoundFollowsFromFallStartAndTension) {
  Scene scene = test::block(4);
  scene.time.fixed_dt.reset();
  scene.gravity = {0, 0, -9.81};
  scene.bodies[0].placement.position = {0, 0, 2};  // its highest particles at 2.15
  scene.bodies[0].velocity = {3, 0, 0};
  scene.forces = {SurfaceFeature{7.4, 1, 500, Direction::displacement}};
  Solid floor;
  floor.shape = Plate{1, 1};
  scene.solids = {floor};
  scene.pressure = Wcsph{};
  const double sigma = 271.0 / 135168 * 7.4 * 1e6 * 0.008;
  const Simulation simulation(scene);
  const double c = *std::get<Wcsph>(simulation.scene().pressure).sound_speed;
  EXPECT_NEAR(c, 10 * std::sqrt(9 + 2 * 9.81 * 2.15 + 16 * sigma / 200), 1e-3);

  scene.pressure = Wcsph{50.0, 7};
  Simulation given(scene);
  EXPECT_EQ(*std::get<Wcsph>(given.scene().pressure).sound_speed, 50);
  given.step();
  EXPECT_EQ(given.last_step().bound, "sound");
  EXPECT_DOUBLE_EQ(given.last_step().dt, 0.4 * 0.1 / 53);
}

TEST(Wcsph, RefusesASceneThatGivesNoSpeedOfSound) {
  Scene scene = test::block(4);  // no gravity, no motion, no tension
  scene.pressure = Wcsph{};
  EXPECT_THROW(Simulation{scene}, SceneError);
}

}  // namespace
}  // namespace sessile::pressure_solvers_test
