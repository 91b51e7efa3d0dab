#include "sessile/output/summary.h"

#include <fmt/format.h>
#include <json/json.h>
#include <sys/resource.h>

#include <cmath>
#include <memory>

#include "sessile/output/file.h"

namespace sessile {
namespace {

/// Lines of one JSON object, in the order they are added; jsoncpp's own would sort them and print 0.1 with 17 digits.
class Object {
 public:
  explicit Object(std::size_t depth) : indent_(2 * depth, ' ') {}

  Object& add(std::string_view key, double value) {
    return raw(key, std::isfinite(value) ? fmt::format("{}", value) : "null");
  }
  Object& add(std::string_view key, std::int64_t value) { return raw(key, fmt::format("{}", value)); }
  Object& add(std::string_view key, std::size_t value) { return raw(key, fmt::format("{}", value)); }
  Object& add(std::string_view key, const std::string& text) {
    return raw(key, Json::valueToQuotedString(text.c_str()));
  }
  Object& raw(std::string_view key, std::string_view json) {
    text_ += fmt::format("{}{}  \"{}\": {}", text_.empty() ? "{\n" : ",\n", indent_, key, json);
    return *this;
  }
  std::string text() const { return fmt::format("{}\n{}}}", text_, indent_); }

 private:
  std::string indent_;
  std::string text_;
};

std::string_view word(RunStatus status) {
  switch (status) {
    case RunStatus::done:
      return "done";
    case RunStatus::interrupted:
      return "interrupted";
    case RunStatus::failed:
      return "failed";
  }
  return "";
}

bool is_json(const std::string& text) {
  Json::Value ignored;
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);
  const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
  return reader->parse(text.data(), text.data() + text.size(), &ignored, nullptr);
}

/// The text with all its lines but the first moved in, so that it reads well inside an object.
std::string indented(std::string_view text) {
  while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  std::string result;
  for (const char c : text) {
    result += c;
    if (c == '\n') result += "  ";
  }
  return result;
}

}  // namespace

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

  Object wall_time(1);
  wall_time.add("total", run.wall_time)
      .add("neighbors", stages.neighbors)
      .add("density", stages.density)
      .add("forces", stages.forces)
      .add("pressure", stages.pressure)
      .add("integration", stages.integration)
      .add("output", run.output_time)
      .add("measures", run.measures_time)
      .add("writer_thread", run.writer_time);
  Object memory(1);
  memory.add("peak", peak_memory()).add("arrays", simulation.bytes);

  Object energy(1);
  energy.add("kinetic_at_start", totals.energy.start)
      .add("work_of_forces", totals.energy.forces)
      .add("work_of_pressure", totals.energy.pressure)
      .add("emitted", totals.energy.emitted)
      .add("out", totals.energy.out)
      .add("kinetic_at_end", totals.energy.kinetic());

  Object summary(0);
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
  write_whole(path, summary_json(run, simulation));
}

}  // namespace sessile
