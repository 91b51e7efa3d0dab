#include "record.h"

#include <omp.h>

#include <algorithm>
#include <type_traits>

#include "sessile/core/error.h"
#include "sessile/output/json_object.h"
#include "sessile/scene/describe.h"
#include "sessile/scene/input_file.h"
#include "sessile/scene/json_text.h"
#include "sessile/version.h"

namespace sessile::app {
namespace {

constexpr std::uintmax_t largest_verdict = std::uintmax_t{64} << 20;  // bytes; it holds a scene, moved in by two blanks

}  // namespace

std::string RunObserver::look(const Simulation& simulation) {
  const StepReport& last = simulation.last_step();
  dt_least_ = dt_least_ > 0 ? std::min(dt_least_, last.dt) : last.dt;
  dt_greatest_ = std::max(dt_greatest_, last.dt);
  predicted_sum_ += last.predicted_error;
  predicted_max_ = std::max(predicted_max_, last.predicted_error);
  soundness_.look(simulation);
  return stop_unsound_ && !soundness_.verdict().sound ? "unsound: " + soundness_.verdict().reason : "";
}

RunRecord RunObserver::record(const SessionResult& result, const ResolvedScene& resolved) {
  if (result.status == RunStatus::failed) soundness_.fail(result.facts.time, result.message);
  if (result.status == RunStatus::done) soundness_.finish();
  const Totals& totals = result.facts.totals;
  const auto steps = static_cast<double>(std::max<std::int64_t>(1, totals.steps));
  RunRecord r;
  r.status = word(result.status);
  r.message = result.message;
  r.sound = result.status == RunStatus::done && soundness_.verdict().sound;
  r.verdict_time = r.sound ? result.facts.time : soundness_.verdict().time;
  r.reason = soundness_.verdict().reason;
  r.pressure_work_share = soundness_.pressure_work_share();
  r.unconverged_share = soundness_.unconverged_share();
  r.density_error = soundness_.density_error();
  r.density_error_max = soundness_.density_error_max();
  r.predicted_error = predicted_sum_ / steps;
  r.predicted_error_max = predicted_max_;
  r.time = result.facts.time;
  r.dt_mean = result.facts.time / steps;
  r.dt_least = dt_least_;
  r.dt_greatest = dt_greatest_;
  r.steps = totals.steps;
  r.iterations = totals.iterations;
  r.divergence_iterations = totals.divergence_iterations;
  r.iterations_per_step = static_cast<double>(totals.iterations) / steps;
  r.unconverged_solves = totals.unconverged_solves;
  r.overruled_steps = totals.overruled_steps;
  r.particles = result.facts.particles;
  r.wall_particles = result.facts.wall_particles;
  r.emitted = totals.emitted;
  r.waits = totals.waits;
  r.out = totals.out;
  r.lost = totals.lost;
  r.energy = totals.energy;
  r.wall = result.wall;
  r.stepping = result.stepping;
  r.neighbors = result.facts.stages.neighbors;
  r.density = result.facts.stages.density;
  r.forces = result.facts.stages.forces;
  r.pressure = result.facts.stages.pressure;
  r.integration = result.facts.stages.integration;
  r.threads = omp_get_max_threads();
  r.version = version();
  r.scene = to_json(resolved.scene);
  return r;
}

std::string verdict_json(const RunRecord& record) {
  JsonObject object(0);
  for_each_figure(record, [&](const char* key, const auto& value) { object.add(key, value); });
  object.raw("scene", indented(record.scene));
  return object.text() + "\n";
}

std::optional<RunRecord> read_verdict(const std::filesystem::path& file) {
  std::string text;
  try {
    text = read_input(file, largest_verdict);
  } catch (const FileError&) {
    return {};
  }
  const auto parsed = parsed_json(text);
  if (!parsed || !parsed->isObject()) return {};
  const Json::Value& json = *parsed;
  RunRecord record;
  bool whole = true;
  for_each_figure(record, [&](const char* key, auto& value) {
    using T = std::remove_cvref_t<decltype(value)>;
    const Json::Value& found = json[key];
    if constexpr (std::is_same_v<T, std::string>) {
      if (whole = whole && found.isString(); whole) value = found.asString();
    } else if constexpr (std::is_same_v<T, bool>) {
      if (whole = whole && found.isBool(); whole) value = found.asBool();
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      if (whole = whole && found.isInt64(); whole) value = found.asInt64();
    } else {
      if (whole = whole && (found.isNumeric() || (found.isNull() && json.isMember(key))); whole)
        value = found.asDouble();
    }
  });
  // The scene's own text: to the byte as it was written, moved back out by two blanks.
  const std::string begin = "\n  \"scene\": ", end = "\n}\n";
  const auto at = text.find(begin);
  if (!whole || at == std::string::npos || !text.ends_with(end)) return {};
  const std::string scene = text.substr(at + begin.size(), text.size() - end.size() - at - begin.size());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    record.scene += scene[i];
    if (scene[i] == '\n') i += 2;
  }
  record.scene += '\n';
  return record;
}

}  // namespace sessile::app
