#include <gtest/gtest.h>

#include <cmath>

#include "support/one_of_each.h"
#include "support/scenes.h"

namespace sessile {
namespace {

// A drop that falls on to a plate by every force with every solver: nothing is lost, and the liquid slows down.
TEST(AnyForce, GoesWithAnySolver) {
  for (const Force& force : test::one_of_each(Force{})) {
    for (const Pressure& solver : test::one_of_each(Pressure{})) {
      Scene scene = test::block(6, 1e-3, 0.1);
      scene.gravity = {0, 0, -9.81};
      scene.bodies[0].placement.position = {0, 0, 0.4};
      scene.bodies[0].velocity = {0, 0, -2};
      Solid plate;
      plate.shape = Plate{2, 2};
      scene.solids = {plate};
      scene.forces = {force};
      scene.pressure = solver;
      const auto name = [](const auto& chosen) {
        return std::visit([](const auto& model) { return std::string(model.name); }, chosen);
      };
      const std::string pair = name(force) + " with " + name(solver);
      Simulation simulation(scene);
      const double before = simulation.totals().energy.start;
      test::run(simulation);
      EXPECT_EQ(simulation.totals().lost, 0) << pair;
      EXPECT_EQ(simulation.particles().size(), 216U) << pair;
      EXPECT_GT(simulation.walls().forces.size(), 0U) << pair;
      const double after = test::kinetic_energy(simulation);
      EXPECT_TRUE(std::isfinite(after)) << pair;
      EXPECT_LT(after, 2.22 * before) << pair;  // what a free fall would have brought: ((2 + 0.1 g)/2)^2
      EXPECT_LT(simulation.totals().energy.pressure, 0) << pair;
    }
  }
}

}  // namespace
}  // namespace sessile
