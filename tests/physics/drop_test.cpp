#include <gtest/gtest.h>

#include <cmath>

#include "sessile/measure/diagnostics.h"
#include "support/scenes.h"

namespace sessile {
namespace {

/// A free cube becomes a sphere: greatest distance over radius of gyration from 1.73 to sqrt(5/3) = 1.29 within 5 %, at
/// rest.
void check_cube(int n, double end) {
  Scene scene = test::block(n, 4e-3, end);
  scene.forces = {SurfaceFeature{}};
  scene.fluid.viscosity = 100;  // Ohnesorge number 0.3; the currents of a drop at rest stay small
  Simulation simulation(scene);
  const double start = measure(simulation).extent.farthest / measure(simulation).extent.radius_of_gyration;
  double peak = 0, energy = 0;
  while (!simulation.finished()) {
    simulation.step();
    energy = test::kinetic_energy(simulation);
    peak = std::max(peak, energy);
  }
  const Diagnostics d = measure(simulation);
  const double ratio = (d.extent.farthest + 0.05) / d.extent.radius_of_gyration;  // to the surface, half a spacing out
  std::printf(
      "cube of %d^3 after %.1f s: largest over gyration radius %.3f -> %.3f, kinetic energy %.2e of its peak, "
      "%lld pieces\n",
      n, end, start, ratio, energy / peak, static_cast<long long>(d.structure.pieces));
  EXPECT_NEAR(ratio, std::sqrt(5.0 / 3), 0.05 * std::sqrt(5.0 / 3));
  EXPECT_LT(energy, 1e-3 * peak);
  EXPECT_EQ(d.structure.pieces, 1);
}

TEST(CubeToSphere, BecomesRoundAndComesToRest) { check_cube(10, 6); }

TEST(CubeToSphereSlow, BecomesRoundAndComesToRest) { check_cube(16, 12); }

/// The same drop at three scales, with Ohnesorge number, Bond number and dt over the capillary time held.
std::vector<double> trajectory(double dx, Vec3d& momentum) {
  const double rho = 1000, sigma = dx < 1e-3 ? 0.0728 : 119, g0 = 9.81;
  // At dx = 0.1 m: mu 20 Pa s, sigma 119 N/m, g 1 m/s^2, dt 4 ms. Oh ~ mu/sqrt(rho sigma L), Bo ~ rho g L^2/sigma.
  const double L = dx / 0.1, s = sigma / 119;
  Scene scene = test::block(8, 4e-3 * std::sqrt(L * L * L / s), 0);
  scene.spacing = dx;
  scene.time.end = 400 * *scene.time.fixed_dt;
  scene.fluid.viscosity = 20 * std::sqrt(s * L);
  scene.gravity = {0, 0, -g0 / 10 * s / (L * L)};
  const double h = scene.support_radius();
  SurfaceFeature model;
  model.cohesion = sigma / (271.0 / 135168 * rho * rho * h * h * h);
  const double acceleration = s / (L * L);  // unit of acceleration at this scale
  model.area_minimisation = acceleration;
  model.adhesion = 500 * model.cohesion / 7.4;
  scene.forces = {model};
  Body& body = scene.bodies[0];
  body.shape = Box{{8 * dx, 8 * dx, 8 * dx}};
  body.placement.position = {0, 0, 5 * dx};
  body.jitter = 0.1;
  Solid floor;
  floor.shape = Plate{24 * dx, 24 * dx};
  scene.solids = {floor};
  Simulation simulation(scene);
  std::vector<double> gyration;
  while (simulation.totals().steps < 300) {
    simulation.step();
    gyration.push_back(measure(simulation).extent.radius_of_gyration / dx);
  }
  momentum = measure(simulation).motion.momentum;
  return gyration;
}

TEST(Scale, TheSameDropFromMicrometresToMetres) {
  Vec3d p;
  const std::vector<double> metres = trajectory(1, p);          // R about 10 m of dx 1 m
  const std::vector<double> millimetres = trajectory(1e-4, p);  // about 1 mm
  const std::vector<double> micrometres = trajectory(1e-6, p);  // about 10 um
  double apart = 0, moved = 0;
  for (std::size_t k = 0; k < metres.size(); ++k) {
    apart = std::max({apart, std::abs(metres[k] / millimetres[k] - 1), std::abs(metres[k] / micrometres[k] - 1)});
    moved = std::max(moved, std::abs(metres[k] / metres[0] - 1));
  }
  std::printf("scale: radii of gyration apart by at most %.4f %%, having changed by %.1f %%\n", 100 * apart,
              100 * moved);
  EXPECT_GT(moved, 0.05) << "nothing happened, so nothing was compared";
  EXPECT_LT(apart, 0.01);
}

}  // namespace
}  // namespace sessile
