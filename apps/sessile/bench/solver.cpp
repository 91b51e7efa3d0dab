#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/context.h"
#include "bench/scenes.h"
#include "sessile/simulation.h"

namespace sessile::app::bench {
namespace {

double iterations_per_step(const Totals& from, const Totals& to) {
  return static_cast<double>(to.iterations - from.iterations) / static_cast<double>(to.steps - from.steps);
}

void column(Context& context) {
  Scene scene = bench_scene("column");
  if (context.particles > 0) scene.time.end = 0.2;  // a trial does not wait until it rests
  const double span = std::min(1.0, scene.time.end / 2);
  Simulation simulation(scene);
  while (simulation.time() < scene.time.end - span) simulation.step();
  const Totals settled = simulation.totals();
  while (!simulation.finished()) simulation.step();
  context.report.add({"solver.column_iterations",
                      "resting column 20 dx deep, iterations a step",
                      "",
                      {iterations_per_step(settled, simulation.totals())}});
  const double mass = simulation.units().particle_mass() * static_cast<double>(simulation.particles().size());
  context.report.remark(
      fmt::format("Over the last {:g} s of {:g}, at an error of {:g} %; at the end particles move at {:.2g} m/s "
                  "(root mean square).",
                  span, scene.time.end, 100 * std::get<Iisph>(scene.pressure).error,
                  std::sqrt(2 * simulation.last_step().kinetic_energy / mass)));
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
