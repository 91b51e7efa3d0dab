#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sessile/measure/diagnostics.h"
#include "sessile/scene/read.h"
#include "support/scenes.h"

/// What the shipped scenes come to, within stated tolerances. Single trajectories are chaotic and differ between
/// instruction sets; their statistics are not.
namespace sessile {
namespace {

Simulation ran(const std::string& name, const std::vector<std::string>& overrides, double* peak_energy = nullptr) {
  Simulation simulation(read_scene(std::string(SESSILE_SCENES) + "/" + name, overrides));
  while (!simulation.finished()) {
    simulation.step();
    if (peak_energy != nullptr) *peak_energy = std::max(*peak_energy, test::kinetic_energy(simulation));
  }
  return simulation;
}

void print(const char* what, const Simulation& simulation) {
  const Diagnostics d = measure(simulation);
  const Structure& s = d.structure;
  const Totals& t = simulation.totals();
  std::printf(
      "%s at %.1f s: kinetic energy %.3f J, first layer %lld of %lld, %lld pieces (largest %.1f %%), gyration %.3f m, "
      "%lld out, %lld lost, %.1f iterations a step, %lld solves above their error\n",
      what, simulation.time(), d.motion.kinetic_energy, static_cast<long long>(s.first_layer),
      static_cast<long long>(d.particles), static_cast<long long>(s.pieces), 100 * s.largest_share,
      d.extent.radius_of_gyration, static_cast<long long>(d.out), static_cast<long long>(d.lost),
      static_cast<double>(t.iterations) / static_cast<double>(t.steps), static_cast<long long>(t.unconverged_solves));
}

/// The paper's Fig. 3c: the block ends as one quiet film, one particle thick, with nothing lost or off the tablet.
void check_tablet(const std::vector<std::string>& overrides) {
  const Simulation simulation = ran("tablet.json", overrides);
  print("tablet", simulation);
  const Diagnostics d = measure(simulation);
  EXPECT_EQ(d.particles, 1728);
  EXPECT_EQ(d.out, 0);
  EXPECT_EQ(d.lost, 0);
  EXPECT_LT(d.motion.kinetic_energy, 1);
  EXPECT_GE(d.structure.first_layer, 0.95 * 1728);
  EXPECT_GE(d.structure.largest_share, 0.90);
  EXPECT_EQ(simulation.totals().unconverged_solves, 0);
}

TEST(Tablet, BecomesAQuietFilm) { check_tablet({"time.end=5"}); }

TEST(Tablet, SpreadsAsItDidBefore) {
  const Simulation simulation = ran("tablet.json", {"time.end=1.5"});
  const Diagnostics d = measure(simulation);
  print("tablet", simulation);
  // Measured when the scene was made: 1.785 m. The film's size follows from cohesion and adhesion; 5 % covers the
  // chaos.
  EXPECT_NEAR(d.extent.radius_of_gyration, 1.785, 0.05 * 1.785);
  EXPECT_NEAR(d.structure.nearest_median, 1.05, 0.05);
}

TEST(TabletSlow, IsAQuietFilmAtEveryStepUpTo8Milliseconds) {
  for (const char* dt : {"0.001", "0.002", "0.004", "0.008"}) {
    SCOPED_TRACE(dt);
    check_tablet({"time.end=5", std::string("time.fixed_dt=") + dt});
  }
}

/// Fig. 3a: without tension and adhesion the same liquid breaks into hundreds of pieces.
TEST(Tablet, BreaksUpWithoutTension) {
  const Simulation simulation = ran("tablet.json", {"time.end=3", "forces=[]"});
  print("tablet without forces", simulation);
  EXPECT_GT(measure(simulation).structure.pieces, 100);
  EXPECT_EQ(simulation.totals().lost, 0);
}

/// At 6 s: before, the farthest particle still draws in (1.34 to 1.37 at 3 s from one solver setting to the next, 1.33
/// to 1.36 at 4 s, 1.33 to 1.34 from 6 s on).
TEST(Drop, BecomesRound) {
  double peak = 0;
  const Simulation simulation = ran("drop.json", {"time.end=6"}, &peak);
  print("drop", simulation);
  const Diagnostics d = measure(simulation);
  const double ratio = (d.extent.farthest + 0.05) / d.extent.radius_of_gyration;
  std::printf("drop: largest over gyration radius %.3f, kinetic energy %.2e of its peak\n", ratio,
              d.motion.kinetic_energy / peak);
  EXPECT_EQ(d.structure.pieces, 1);
  EXPECT_NEAR(ratio, std::sqrt(5.0 / 3), 0.05 * std::sqrt(5.0 / 3));
  EXPECT_LT(d.motion.kinetic_energy, 1e-2 * peak);
  EXPECT_NEAR(d.extent.radius_of_gyration, 0.579, 0.03 * 0.579);  // sqrt(3/5) R of the same volume, R = 0.744 m
}

/// Fig. 4: the board holds a film, the rest runs over its edges and out; every particle is accounted for.
TEST(SpillSlow, TheBoardHoldsAFilmAndTheRestRunsOff) {
  const Simulation simulation = ran("spill.json", {});
  print("spill", simulation);
  const Diagnostics d = measure(simulation);
  EXPECT_EQ(simulation.totals().emitted, 32768);
  EXPECT_EQ(d.particles + d.out, 32768);
  EXPECT_EQ(d.lost, 0);
  EXPECT_GT(d.out, 0);
  EXPECT_GT(d.structure.first_layer, 1000);
}

}  // namespace
}  // namespace sessile
