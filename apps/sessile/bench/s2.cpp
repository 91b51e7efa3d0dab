#include <fmt/format.h>

#include <array>
#include <utility>

#include "bench/context.h"
#include "bench/scenes.h"
#include "machine.h"
#include "sessile/output/summary.h"
#include "sessile/simulation.h"

namespace sessile::app::bench {
namespace {

constexpr int steps = 3;  // of a batch

using Stage = std::pair<const char*, double StageTimes::*>;
constexpr std::array<Stage, 6> stages{{{"neighbors", &StageTimes::neighbors},
                                       {"density", &StageTimes::density},
                                       {"forces", &StageTimes::forces},
                                       {"time_step", &StageTimes::time_step},
                                       {"pressure", &StageTimes::pressure},
                                       {"integration", &StageTimes::integration}}};

/// Batches of a few steps of a block that starts to break: time by stage, and memory.
void bench_block(Context& context, const std::string& name, const std::string& title) {
  Report& report = context.report;
  report.section(title);
  const bool knows_peak = forget_peak_memory();
  const std::size_t before = resident_memory();
  Simulation simulation(bench_scene(name, context.particles));
  for (int k = 0; k < 2; ++k) simulation.step();  // the first ones find no memory yet, and no pressures

  Figure whole{name + ".ms_per_step", "a step", "ms", {}};
  std::vector<Figure> parts;
  for (const auto& [stage, member] : stages) {
    parts.push_back({name + ".stage." + stage, std::string("  of it ") + stage, "ms", {}});
  }
  Figure outside{name + ".stage.outside", "  outside all stages", "ms", {}};
  const Totals first = simulation.totals();
  for (int batch = 0; batch < context.runs; ++batch) {
    const StageTimes start = simulation.stage_times();
    const double wall = seconds([&] {
      for (int k = 0; k < steps; ++k) simulation.step();
    });
    const StageTimes end = simulation.stage_times();
    whole.samples.push_back(1e3 * wall / steps);
    for (std::size_t k = 0; k < stages.size(); ++k) {
      const auto member = stages[k].second;
      parts[k].samples.push_back(1e3 * (end.*member - start.*member) / steps);
    }
    outside.samples.push_back(1e3 * (wall - (end.sum() - start.sum())) / steps);
  }
  const std::size_t peak = peak_memory();

  const auto n = static_cast<double>(simulation.particles().size());
  report.add(std::move(whole));
  for (Figure& part : parts) report.add(std::move(part));
  report.add(std::move(outside));
  const auto turns = static_cast<double>(simulation.totals().iterations - first.iterations);
  report.add({name + ".iterations",
              "iterations a step",
              "",
              {turns / static_cast<double>(simulation.totals().steps - first.steps)}});
  report.add({name + ".bytes_per_particle",
              "memory by its own account",
              "B/particle",
              {static_cast<double>(simulation.bytes()) / n}});
  if (knows_peak && peak > before) {
    report.add({name + ".peak_bytes_per_particle",
                "peak memory it touched, setting up too",
                "B/particle",
                {static_cast<double>(peak - before) / n}});
  }
  report.remark(
      fmt::format("{} particles, {} boundary particles.", simulation.particles().size(), simulation.walls().size()));
}

}  // namespace

void bench_s2_250k(Context& context) {
  bench_block(context, "s2_250k", "S2: breaking dam of 250 000, at 2 iterations");
}
void bench_s2_1m(Context& context) { bench_block(context, "s2_1m", "S2: breaking dam of 1 000 000, at 2 iterations"); }

}  // namespace sessile::app::bench
