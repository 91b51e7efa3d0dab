#include "sessile/output/summary.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <json/json.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>

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

std::string list_of(const Vec3d& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

JsonObject fault_object(const RunFault& fault, std::size_t depth) {
  JsonObject object(depth);
  object.add("kind", std::string(word(fault.kind)))
      .add("message", fault.message)
      .add("time_s", fault.time)
      .add("step", fault.step)
      .add("dt_s", fault.dt)
      .add("bound", std::string(fault.bound))
      .add("overruled", std::string(fault.overruled))
      .add("particles", fault.count)
      .add("particle", fault.particle);
  const auto finite = [](const Vec3d& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
  if (finite(fault.position)) object.raw("position_m", list_of(fault.position));
  if (finite(fault.velocity)) object.raw("velocity_m_s", list_of(fault.velocity));
  return object;
}

std::string stability_json(const StabilityFacts& facts) {
  JsonObject object(1);
  object.add("went_back", facts.went_back).add("undone_steps", facts.undone_steps).add("last_fault", facts.last_fault);
  if (facts.fault) {
    object.raw("fault", fault_object(*facts.fault, 2).text());
  } else {
    object.raw("fault", "null");
  }
  return object.text();
}

}  // namespace

std::string fault_json(const RunFault& fault, const std::string& advice) {
  return fault_object(fault, 0).add("advice", advice).text();
}

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

// Not getrusage(): what it tells may be of the process that started this one. And without memory of its own: it is
// asked when there is no more.
std::size_t peak_memory() {
  std::array<char, 8192> text{};
  const int file = open("/proc/self/status", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const ssize_t size = read(file, text.data(), text.size() - 1);
  close(file);
  const char* const line = size > 0 ? std::strstr(text.data(), "VmHWM:") : nullptr;
  return line == nullptr ? 0 : 1024 * std::strtoull(line + 6, nullptr, 10);
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
      .raw("stability", stability_json(run.stability))
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
