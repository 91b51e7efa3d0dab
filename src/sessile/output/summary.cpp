#include "sessile/output/summary.h"

#include <json/json.h>
#include <sys/resource.h>

#include <memory>

#include "sessile/output/durable.h"
#include "sessile/output/json_object.h"

namespace sessile {
namespace {

bool is_json(const std::string& text) {
  Json::Value ignored;
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);
  const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
  return reader->parse(text.data(), text.data() + text.size(), &ignored, nullptr);
}

}  // namespace

std::string_view word(RunStatus status) {
  switch (status) {
    case RunStatus::done:
      return "done";
    case RunStatus::interrupted:
      return "interrupted";
    case RunStatus::failed:
      return "failed";
    case RunStatus::stopped:
      return "stopped";
  }
  return "";
}

std::size_t peak_memory() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

std::string summary_json(const RunFacts& run, const SimulationFacts& simulation) {
  const Totals& totals = simulation.totals;
  const StageTimes& stages = simulation.stages;
  const double per_step =
      totals.steps > 0 ? static_cast<double>(totals.iterations) / static_cast<double>(totals.steps) : 0;

  JsonObject wall_time(1);
  wall_time.add("total", run.wall_time)
      .add("neighbors", stages.neighbors)
      .add("density", stages.density)
      .add("forces", stages.forces)
      .add("time_step", stages.time_step)
      .add("pressure", stages.pressure)
      .add("integration", stages.integration)
      .add("output", run.output_time)
      .add("measures", run.measures_time)
      .add("writer_thread", run.writer_time);
  JsonObject memory(1);
  memory.add("peak", peak_memory()).add("arrays", simulation.bytes);

  JsonObject energy(1);
  energy.add("kinetic_at_start", totals.energy.start)
      .add("work_of_forces", totals.energy.forces)
      .add("work_of_pressure", totals.energy.pressure)
      .add("emitted", totals.energy.emitted)
      .add("out", totals.energy.out)
      .add("kinetic_at_end", totals.energy.kinetic());

  JsonObject summary(0);
  summary.add("status", std::string(word(run.status)))
      .add("message", run.message)
      .add("version", run.version)
      .add("particles", simulation.particles)
      .add("wall_particles", simulation.wall_particles)
      .add("simulated_time_s", simulation.time)
      .add("steps", totals.steps)
      .add("frames", run.frames)
      .add("iterations", totals.iterations)
      .add("iterations_per_step", per_step)
      .add("divergence_iterations", totals.divergence_iterations)
      .add("unconverged_solves", totals.unconverged_solves)
      .add("overruled_steps", totals.overruled_steps)
      .add("emitted", totals.emitted)
      .add("waits", totals.waits)
      .add("out", totals.out)
      .add("lost", totals.lost)
      .raw("energy_J", energy.text())
      .raw("wall_time_s", wall_time.text())
      .raw("memory_bytes", memory.text());
  if (is_json(run.scene_json)) {
    summary.raw("scene", indented(run.scene_json));
  } else {
    summary.add("scene", run.scene_json);
  }
  return summary.text() + "\n";
}

void write_summary(const std::filesystem::path& path, const RunFacts& run, const SimulationFacts& simulation) {
  write_durably(path, summary_json(run, simulation));
}

}  // namespace sessile
