#include "fuzz/small_simulation.h"

#include <variant>

#include "fuzz/targets.h"
#include "sessile/scene/sampling.h"
#include "sessile/simulation.h"

namespace sessile::fuzz {
namespace {

constexpr double small = 3000;  // particles and samples

double points_of(const Scene& scene) {
  double points = 0;
  for (const Body& body : scene.bodies) points += estimate_fill(body, scene.spacing);
  for (const Emitter& emitter : scene.emitters) points += estimate_layer(emitter, scene.spacing);
  for (const Solid& solid : scene.solids) points += estimate_surface(solid, scene.spacing);
  if (scene.domain) {
    for (const Solid& wall : domain_walls(*scene.domain)) points += estimate_surface(wall, scene.spacing);
  }
  return points;
}

Scene with_short_solves(Scene scene) {
  std::visit(
      [](auto& solver) {
        if constexpr (requires { solver.max_iterations; }) {
          solver.max_iterations = 3;
          solver.min_iterations = 1;
          solver.long_solve = 3;
        }
      },
      scene.pressure);
  return scene;
}

}  // namespace

void run_when_small(const Scene& scene) {
  const double points = points_of(scene);
  if (points > small && points < 2.2e9) return;  // what is larger must be refused at once
  Simulation simulation(with_short_solves(scene));
  must(static_cast<double>(simulation.particles().size() + simulation.walls().size()) <= 2 * small,
       "more points than were estimated");
  simulation.step();
}

void go_on_when_small(const Scene& scene, const SimulationState& state) {
  if (points_of(scene) > small || static_cast<double>(state.particles.size()) > small) return;
  Simulation simulation(with_short_solves(scene), state);
  must(simulation.particles().size() == state.particles.size(), "a state comes back with other particles");
  for (int k = 0; k < 2; ++k) simulation.step();
}

}  // namespace sessile::fuzz
