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

/// Hydrostatic column 20 dx deep: p = rho g (H - z) to 2 % in L2, and a surface that drifts less than dx/2.
void check_column(double settle, double watch) {
  Scene scene = test::column(8, 20, 4e-3);
  scene.time.end = settle + watch;
  Simulation simulation(scene);
  while (simulation.time() < settle) simulation.step();
  const double before = top(simulation);
  // The pressure of one step flickers as the solver stops at its tolerance: average over half a second.
  std::vector<double> pressure(simulation.particles().size()), height(pressure.size());
  int samples = 0;
  while (!simulation.finished()) {
    simulation.step();
    if (simulation.time() < scene.time.end - 0.5) continue;
    ++samples;
    const Particles& p = simulation.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto id = static_cast<std::size_t>(p.id[i]);
      pressure[id] += 1000 * static_cast<double>(p.pressure[i]);
      height[id] += static_cast<double>(p.position.z[i]);
    }
  }
  EXPECT_LT(std::abs(top(simulation) - before), 0.05) << "drift of the surface";
  const double surface = top(simulation) + 0.05;
  double squares = 0, scale = 0;
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    const double expected = 1000 * 9.81 * (surface - height[i] / samples);
    squares += std::pow(pressure[i] / samples - expected, 2);
    scale += expected * expected;
  }
  std::printf("hydrostatic column: L2 error %.2f %%, drift %.4f dx, %.1f iterations a step\n",
              100 * std::sqrt(squares / scale), (top(simulation) - before) / 0.1,
              static_cast<double>(simulation.totals().iterations) / static_cast<double>(simulation.totals().steps));
  EXPECT_LT(std::sqrt(squares / scale), 0.02);
  // The floor carries the weight.
  const double weight = static_cast<double>(pressure.size()) * simulation.units().particle_mass() * 9.81;
  EXPECT_NEAR(simulation.walls().forces[0].force.z / -weight, 1, 0.02);
  EXPECT_EQ(simulation.totals().lost, 0);
}

TEST(HydrostaticColumn, CarriesItsWeight) { check_column(1, 1); }

TEST(HydrostaticColumnSlow, StandsStillForFiveSeconds) { check_column(2, 5); }

/// Flow between plates under a body force: u_max = rho g d^2/(2 mu), d half the gap.
void check_poiseuille(int layers, double tolerance) {
  Scene scene = test::column(6, layers);
  const double dx = scene.spacing;
  const double gap = (layers + 1) * dx;
  scene.gravity = {0.1, 0, 0};
  scene.fluid.viscosity = 100;
  scene.time.fixed_dt.reset();
  scene.time.dt_max = 0.01;
  const double half = gap / 2, nu = scene.fluid.viscosity / scene.fluid.rest_density;
  scene.time.end = 2 * half * half / nu;  // the slowest mode has died to 0.7 %
  Solid lid = scene.solids[0];
  lid.label = "lid";
  lid.placement.position = {0, 0, gap};
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
