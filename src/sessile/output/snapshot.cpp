#include "sessile/output/snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sessile/core/error.h"
#include "sessile/simulation.h"

namespace sessile {
namespace {

Column acceleration_column(const Simulation& simulation, const std::string& name) {
  const std::string force = name.substr(acceleration_prefix.size());
  return {name, "m/s^2", 3, interleaved(simulation.acceleration(force))};
}

bool is_acceleration(const Simulation& simulation, std::string_view name) {
  if (!name.starts_with(acceleration_prefix)) return false;
  const std::vector<std::string> forces = simulation.acceleration_names();
  return std::find(forces.begin(), forces.end(), name.substr(acceleration_prefix.size())) != forces.end();
}

}  // namespace

Snapshot take_snapshot(const Simulation& simulation, std::span<const std::string> columns) {
  Snapshot snapshot{simulation.time(), simulation.totals().steps, interleaved(simulation.particles().position), {}};
  for (const std::string& name : columns) {
    if (auto column = plain_column(simulation, name)) {
      snapshot.columns.push_back(*std::move(column));
    } else if (is_acceleration(simulation, name)) {
      snapshot.columns.push_back(acceleration_column(simulation, name));
    } else {
      throw Error(fmt::format("unknown field \"{}\"", name));
    }
  }
  return snapshot;
}

Snapshot take_solids(const Walls& walls) {
  Snapshot snapshot{0, 0, interleaved(walls.position), {}};
  snapshot.columns.push_back({"solid", "", 1, std::vector<std::int64_t>(walls.solid.begin(), walls.solid.end())});
  return snapshot;
}

}  // namespace sessile
