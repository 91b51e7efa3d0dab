#include "sessile/output/summary.h"

namespace sessile {

SimulationFacts simulation_facts(const Simulation& simulation) {
  return {static_cast<std::int64_t>(simulation.particles().size()),
          static_cast<std::int64_t>(simulation.walls().size()),
          simulation.time(),
          simulation.totals(),
          simulation.stage_times(),
          simulation.bytes()};
}

}  // namespace sessile
