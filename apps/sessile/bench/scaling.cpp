#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>

#include "bench/context.h"
#include "bench/scenes.h"
#include "machine.h"
#include "sessile/simulation.h"

namespace sessile::app::bench {
namespace {

constexpr int iterations = 4;             // of a step, at every size
constexpr std::size_t peak_bytes = 1200;  // a particle, setting up too: what must be free to try a size

/// Steps of a batch: about as long at every size.
int steps_for(std::size_t n) { return static_cast<int>(std::clamp<std::size_t>(500'000 / n, 1, 20)); }

/// us per particle and step of a batch.
double batch(Simulation& simulation) {
  const std::size_t n = simulation.particles().size();
  const int steps = steps_for(n);
  const double wall = seconds([&] {
    for (int k = 0; k < steps; ++k) simulation.step();
  });
  return 1e6 * wall / (steps * static_cast<double>(n));
}

/// Seconds that one look at the clock takes.
double clock_cost() {
  constexpr int looks = 200'000;
  return seconds([] {
           for (int k = 0; k < looks; ++k) (void)std::chrono::steady_clock::now();
         }) /
         looks;
}

/// What the timers of the stages take of a step that takes `step` seconds.
void timers(Context& context, Simulation& simulation, double step) {
  const std::int64_t before = simulation.stage_times().clock_reads;
  simulation.step();
  const auto reads = static_cast<double>(simulation.stage_times().clock_reads - before);
  Figure figure{"scaling.timers", fmt::format("timers, share of a step of {}", simulation.particles().size()), "%", {}};
  for (int k = 0; k < context.runs; ++k) figure.samples.push_back(100 * reads * clock_cost() / step);
  context.report.add(std::move(figure));
}

std::vector<double> ratio(const Figure& a, const Figure& b) {
  std::vector<double> result;
  for (std::size_t k = 0; k < a.samples.size(); ++k) result.push_back(a.samples[k] / b.samples[k]);
  return result;
}

Figure size_figure(std::size_t n) {
  return {fmt::format("scaling.{}", n), fmt::format("{} particles", n), "us/particle/step", {}};
}

void bench_threads(Context& context, int edge) {
  if (context.threads == 1) {
    context.report.remark("Threads are not compared: the run has one.");
    return;
  }
  Simulation simulation(block_scene(edge, iterations));
  for (int k = 0; k < 2; ++k) simulation.step();
  Figure one = size_figure(simulation.particles().size()), all = one;
  for (int run = 0; run < context.runs; ++run) {
    omp_set_num_threads(1);
    one.samples.push_back(batch(simulation));
    omp_set_num_threads(context.threads);
    all.samples.push_back(batch(simulation));
  }
  context.report.add({fmt::format("scaling.speedup_{}", context.threads),
                      fmt::format("1 to {} threads, {}: speedup", context.threads, one.what), "", ratio(one, all)});
}

}  // namespace

void bench_scaling(Context& context) {
  context.report.section(fmt::format("Falling blocks at {} iterations", iterations));
  std::vector<int> edges{32, 64, 100, 160};  // 32k, 262k, 1M, 4M
  if (context.particles > 0) edges = {edge_of(context.particles), edge_of(2 * context.particles)};
  std::vector<Figure> measured;
  for (const int edge : edges) {
    const auto n = static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge);
    const std::size_t free = available_memory();
    if (free > 0 && free < n * peak_bytes) {
      context.report.remark(fmt::format("{} particles are left out: they take up to {:.1f} GiB, and {:.1f} are free.",
                                        n, static_cast<double>(n * peak_bytes) / (1 << 30),
                                        static_cast<double>(free) / (1 << 30)));
      continue;
    }
    Simulation simulation(block_scene(edge, iterations));
    for (int k = 0; k < 2; ++k) simulation.step();
    Figure figure = size_figure(n);
    for (int run = 0; run < context.runs; ++run) figure.samples.push_back(batch(simulation));
    context.report.add(figure);
    if (measured.empty()) timers(context, simulation, 1e-6 * figure.median() * static_cast<double>(n));
    measured.push_back(std::move(figure));
  }
  if (measured.size() == edges.size()) {
    context.report.add(
        {"scaling.growth", "growth from the smallest to the largest", "", ratio(measured.back(), measured.front())});
  }
  bench_threads(context, edges[1]);
}

}  // namespace sessile::app::bench
