#include "sessile/output/snapshot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "sessile/core/error.h"
#include "sessile/measure/diagnostics.h"
#include "sessile/output/summary.h"
#include "sessile/simulation.h"

namespace sessile {
namespace {

/// 4 x 4 x 4 particles of 0.8 kg, one dx above a plate, moving at 3 m/s.
Simulation block_over_plate() {
  Scene scene;
  scene.spacing = 0.1;
  scene.time.end = 1;
  scene.gravity = {1, 0, -9};
  scene.forces.push_back(SurfaceFeature{});
  Body body;
  body.shape = Box{{0.4, 0.4, 0.4}};
  body.placement.position = {0, 0, 0.25};  // lowest centres at 0.1
  body.velocity = {1, 2, -2};
  body.mass_factor = 0.8;
  scene.bodies.push_back(body);
  Solid plate;
  plate.label = "plate";
  plate.shape = Plate{1, 1};
  scene.solids.push_back(plate);
  return Simulation(scene);
}

template <class T>
const std::vector<T>& values_of(const Snapshot& snapshot, const std::string& name) {
  const auto found = std::find_if(snapshot.columns.begin(), snapshot.columns.end(),
                                  [&](const Column& column) { return column.name == name; });
  EXPECT_NE(found, snapshot.columns.end()) << name;
  return std::get<std::vector<T>>(found->values);
}

TEST(Snapshot, CopiesEveryKnownFieldInSiUnits) {
  const Simulation simulation = block_over_plate();
  std::vector<std::string> names;
  for (const KnownColumn& column : known_columns()) {
    if (column.name != "acceleration_<force>") names.emplace_back(column.name);
  }
  for (const std::string& force : simulation.acceleration_names()) {
    names.push_back(std::string(acceleration_prefix) + force);
  }
  const Snapshot snapshot = take_snapshot(simulation, names);
  const std::size_t n = simulation.particles().size();
  ASSERT_EQ(n, 64u);
  ASSERT_EQ(snapshot.size(), n);
  ASSERT_EQ(snapshot.columns.size(), names.size());
  for (const Column& column : snapshot.columns) {
    std::visit([&](const auto& values) { EXPECT_EQ(values.size(), n * static_cast<std::size_t>(column.components)); },
               column.values);
  }

  std::vector<std::int64_t> ids = values_of<std::int64_t>(snapshot, "id"), all(n);
  std::sort(ids.begin(), ids.end());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(ids, all);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(snapshot.points[3 * i + 2], static_cast<float>(simulation.particles().position.z[i]));
    EXPECT_EQ(values_of<float>(snapshot, "velocity")[3 * i + 1], 2);
    EXPECT_NEAR(values_of<float>(snapshot, "speed")[i], 3, 1e-6);
    EXPECT_NEAR(values_of<float>(snapshot, "mass")[i], 0.8, 1e-6);
    EXPECT_NEAR(values_of<float>(snapshot, "density")[i], 1000 * simulation.density()[i], 1e-3);
    EXPECT_EQ(values_of<float>(snapshot, "pressure")[i], 0);
    EXPECT_EQ(values_of<float>(snapshot, "acceleration_gravity")[3 * i], 1);
    EXPECT_EQ(values_of<float>(snapshot, "acceleration_gravity")[3 * i + 2], -9);
    EXPECT_EQ(values_of<std::int64_t>(snapshot, "neighbors")[i], simulation.fluid_neighbors().count(i));
    EXPECT_EQ(values_of<std::int64_t>(snapshot, "wall_neighbors")[i], simulation.wall_neighbors().count(i));
    // Normals point into the liquid: on the whole towards the block's middle.
    if (snapshot.points[3 * i + 2] > 0.35f) {
      EXPECT_LT(values_of<float>(snapshot, "normal")[3 * i + 2], 0);
    }
  }
}

TEST(Snapshot, RefusesUnknownFields) {
  const Simulation simulation = block_over_plate();
  for (const char* name : {"colour", "acceleration_", "acceleration_<force>", "acceleration_magic"}) {
    EXPECT_THROW(take_snapshot(simulation, std::vector<std::string>{name}), Error) << name;
  }
}

TEST(Snapshot, CopiesTheSolids) {
  const Simulation simulation = block_over_plate();
  const Snapshot solids = take_solids(simulation.walls());
  EXPECT_EQ(solids.size(), simulation.walls().size());
  EXPECT_GT(solids.size(), 80u);
  EXPECT_EQ(values_of<std::int64_t>(solids, "solid"), std::vector<std::int64_t>(solids.size(), 0));
}

TEST(Measure, ReadsTheSimulation) {
  const Simulation simulation = block_over_plate();
  const Diagnostics measured = measure(simulation);
  EXPECT_EQ(measured.particles, 64);
  EXPECT_NEAR(measured.motion.kinetic_energy, 0.5 * 64 * 0.8 * 9, 1e-3);
  EXPECT_NEAR(measured.motion.potential_energy, 64 * 0.8 * 9 * 0.25, 1e-3);
  EXPECT_NEAR(measured.motion.momentum.z, 64 * 0.8 * -2, 1e-3);
  EXPECT_NEAR(measured.motion.max_speed, 3, 1e-6);
  EXPECT_NEAR(measured.extent.centre.z, 0.25, 1e-6);
  EXPECT_NEAR(measured.extent.radius_of_gyration, 0.1 * std::sqrt(15 / 4.0), 1e-6);
  EXPECT_EQ(measured.structure.pieces, 1);
  EXPECT_EQ(measured.structure.largest_share, 1);
  EXPECT_EQ(measured.structure.loose, 0);
  EXPECT_EQ(measured.structure.first_layer, 16);
  EXPECT_NEAR(measured.structure.nearest_median, 1, 1e-4);
  EXPECT_EQ(measured.out + measured.lost, 0);
}

TEST(SimulationFacts, AreTheSimulations) {
  Simulation simulation = block_over_plate();
  simulation.step();
  const SimulationFacts facts = simulation_facts(simulation);
  EXPECT_EQ(facts.particles, 64);
  EXPECT_EQ(facts.wall_particles, static_cast<std::int64_t>(simulation.walls().size()));
  EXPECT_EQ(facts.time, simulation.time());
  EXPECT_EQ(facts.totals.steps, 1);
  EXPECT_GT(facts.stages.pressure, 0);
  EXPECT_GT(facts.bytes, 64u * 4 * 20);
}

}  // namespace
}  // namespace sessile
