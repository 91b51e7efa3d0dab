#include "sessile/measure/passes.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/context.h"
#include "bench/scenes.h"
#include "sessile/simulation.h"

namespace sessile::app::bench {
namespace {

std::string key_of(std::string_view pass, std::size_t n) {
  std::string key = fmt::format("passes.{}.{}", pass, n);
  std::replace(key.begin(), key.end(), ' ', '_');
  return key;
}

void bench_size(Context& context, int edge) {
  const Simulation simulation(block_scene(edge, 2));
  const std::size_t n = simulation.particles().size();
  double pairs = 0;
  for (std::size_t i = 0; i < n; ++i) pairs += simulation.fluid_neighbors().count(i);
  const double neighbors = pairs / static_cast<double>(n);
  context.report.section(fmt::format("Passes over {} particles, {:.1f} neighbours each", n, neighbors));

  std::vector<Figure> figures;
  for (const Pass& pass : passes()) {
    figures.push_back({key_of(pass.name, n), std::string(pass.name), "ns core/particle", {}, neighbors});
  }
  // In turn, so that what disturbs the machine for a while disturbs all. Small sets take many calls for a sample.
  const std::size_t calls = std::max<std::size_t>(1, (context.particles > 0 ? 10'000 : 500'000) / n);
  PassScratch scratch;
  for (int run = 0; run < context.runs; ++run) {
    for (std::size_t k = 0; k < figures.size(); ++k) {
      const auto pass = passes()[k].run;
      pass(simulation, scratch);
      const double wall = seconds([&] {
        for (std::size_t call = 0; call < calls; ++call) pass(simulation, scratch);
      });
      figures[k].samples.push_back(1e9 * wall * context.threads / static_cast<double>(calls * n));
    }
  }
  for (std::size_t k = 0; k < figures.size(); ++k) {
    figures[k].bound = context.ceilings.bound(passes()[k].work, static_cast<double>(n), neighbors, context.threads);
    context.report.add(std::move(figures[k]));
  }
}

}  // namespace

void bench_passes(Context& context) {
  if (context.particles > 0) return bench_size(context, edge_of(context.particles));
  for (const int edge : {32, 64, 100}) bench_size(context, edge);
}

}  // namespace sessile::app::bench
