#include <fmt/format.h>

#include <algorithm>

#include "bench/context.h"
#include "bench/scenes.h"
#include "sessile/simulation.h"

namespace sessile::app::bench {
namespace {

double iterations_per_step(const Totals& from, const Totals& to) {
  return static_cast<double>(to.iterations - from.iterations) / static_cast<double>(to.steps - from.steps);
}

void column(Context& context) {
  const Scene scene = bench_scene("column");
  Simulation simulation(scene);
  while (simulation.time() < scene.time.end - 1) simulation.step();
  const Totals settled = simulation.totals();
  double fastest = 0;
  while (!simulation.finished()) {
    simulation.step();
    const Array3& velocity = simulation.particles().velocity;
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      fastest = std::max(fastest, static_cast<double>(squared_length(velocity[i])));
    }
  }
  context.report.add({"solver.column_iterations",
                      "resting column 20 dx deep, iterations a step",
                      "",
                      {iterations_per_step(settled, simulation.totals())}});
  context.report.remark(fmt::format(
      "Over the last second of {:g}, at an error of {:g} %; nothing moved faster than {:.2g} m/s meanwhile.",
      scene.time.end, 100 * std::get<Iisph>(scene.pressure).error, std::sqrt(fastest)));
}

}  // namespace

void bench_solver(Context& context) {
  context.report.section("Pressure solver");
  column(context);
  if (!context.s1_iterations) {
    Simulation simulation(bench_scene("s1", context.particles));
    while (!simulation.finished()) simulation.step();
    context.s1_iterations = iterations_per_step({}, simulation.totals());
  }
  context.report.add({"solver.s1_iterations", "S1 to 0.01 %, iterations a step", "", {*context.s1_iterations}});
}

}  // namespace sessile::app::bench
