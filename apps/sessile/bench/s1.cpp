#include <fmt/format.h>

#include "bench/context.h"
#include "bench/scenes.h"
#include "sessile/simulation.h"

namespace sessile::app::bench {
namespace {

/// Whole runs of a scene, one sample each.
struct WholeRuns {
  std::vector<double> wall;  // of the steps alone [s]
  Totals totals{};           // of one run: they are all the same
};

WholeRuns whole_runs(const Scene& scene, int runs) {
  WholeRuns result;
  for (int k = 0; k < runs; ++k) {
    Simulation simulation(scene);
    result.wall.push_back(seconds([&] {
      while (!simulation.finished()) simulation.step();
    }));
    result.totals = simulation.totals();
  }
  return result;
}

double per_step(std::int64_t count, const Totals& totals) {
  return static_cast<double>(count) / static_cast<double>(totals.steps);
}

void say_what_is_unsound(Context& context, const Totals& totals) {
  if (totals.lost + totals.unconverged_solves + totals.overruled_steps == 0) return;
  context.report.remark(fmt::format("{} passages through solids, {} solves above their error, {} steps above a bound.",
                                    totals.lost, totals.unconverged_solves, totals.overruled_steps));
}

}  // namespace

void bench_s1(Context& context) {
  context.report.section("S1: fall and impact");
  const WholeRuns runs = whole_runs(bench_scene("s1", context.particles), context.runs);
  Figure step{"s1.ms_per_step", "IISPH to 0.01 %, dt 2 ms, 0.5 s", "ms/step", {}};
  for (const double wall : runs.wall) step.samples.push_back(1e3 * wall / static_cast<double>(runs.totals.steps));
  context.report.add(std::move(step));
  context.s1_iterations = per_step(runs.totals.iterations, runs.totals);
  say_what_is_unsound(context, runs.totals);
}

void bench_s1_fast(Context& context) {
  context.report.section("S1 at the fastest sound settings");
  const Scene scene = bench_scene("s1_fast", context.particles);
  const WholeRuns runs = whole_runs(scene, context.runs);
  context.report.add({"s1_fast.wall", fmt::format("{:g} s of S1", scene.time.end), "s", runs.wall});
  context.report.add({"s1_fast.steps", "steps", "", {static_cast<double>(runs.totals.steps)}});
  context.report.add({"s1_fast.iterations", "iterations a step", "", {per_step(runs.totals.iterations, runs.totals)}});
  say_what_is_unsound(context, runs.totals);
}

}  // namespace sessile::app::bench
