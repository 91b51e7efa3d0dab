#include "comparison.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <type_traits>

#include "machine.h"
#include "sessile/output/json_object.h"
#include "sessile/version.h"

namespace sessile::app {
namespace {

std::string list(const std::vector<std::string>& entries) { return fmt::format("[{}]", fmt::join(entries, ", ")); }

std::string json_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

/// The figures of a run, its outcome behind them.
std::string run_json(const RunRecord& run, const std::string& step, const std::string& folder, const Outcome* outcome,
                     std::size_t depth) {
  JsonObject object(depth);
  object.add("step", step).add("folder", folder);
  for_each_figure(run, [&](const char* key, const auto& value) { object.add(key, value); });
  if (outcome != nullptr && outcome->known) {
    JsonObject courses(depth + 1);
    if (outcome->time_to_rest) {
      courses.add("time_to_rest_s", *outcome->time_to_rest);
    } else {
      courses.raw("time_to_rest_s", "null");
    }
    for (std::size_t i = 0; i < quantities.size(); ++i) {
      if (!outcome->courses[i]) continue;
      const Course& course = *outcome->courses[i];
      courses.raw(quantities[i].key, fmt::format("{{\"final\": {}, \"least\": {}, \"greatest\": {}, \"unit\": \"{}\"}}",
                                                 json_number(course.final), json_number(course.least),
                                                 json_number(course.greatest), quantities[i].unit));
    }
    object.raw("outcome", courses.text());
  }
  return object.text();
}

std::string method_json(const MethodReport& method) {
  JsonObject object(2);
  object.add("name", method.name).add("title", method.title).add("file", method.file);
  std::vector<std::string> runs, trials;
  if (method.run) runs.push_back(run_json(*method.run, method.kind, method.name, &method.outcome, 3));
  if (method.largest) {
    runs.push_back(
        run_json(method.largest->record, "largest fixed", method.largest->folder, &method.largest_outcome, 3));
  }
  for (const TrialReport& trial : method.trials) {
    JsonObject each(3);
    each.add("dt_s", trial.dt)
        .add("to_the_end", trial.whole)
        .add("folder", trial.folder)
        .add("status", trial.record.status)
        .add("sound", trial.record.sound)
        .add("verdict_time_s", trial.record.verdict_time)
        .add("reason", trial.record.reason)
        .add("steps", trial.record.steps)
        .add("wall_time_s", trial.record.wall)
        .add("stepping_time_s", trial.record.stepping);
    trials.push_back(each.text());
  }
  object.raw("runs", list(runs)).add("searched", method.searched);
  if (method.largest) {
    object.add("largest_sound_dt_s", method.largest->dt);
  } else {
    object.raw("largest_sound_dt_s", "null");
  }
  object.raw("trials", list(trials));
  if (method.run) object.raw("scene", indented(indented(method.run->scene)));
  return object.text();
}

/// Text as one field of a CSV file.
std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c == '\n' || c == '\r' ? ' ' : c);
  return quoted + '"';
}

}  // namespace

std::vector<Row> rows_of(const Comparison& comparison) {
  std::vector<Row> rows;
  for (const MethodReport& method : comparison.methods) {
    if (method.run) rows.push_back({&method, method.kind, &*method.run, &method.outcome});
    if (method.largest) rows.push_back({&method, "largest fixed", &method.largest->record, &method.largest_outcome});
  }
  return rows;
}

std::vector<Row> fastest_sound(const Comparison& comparison) {
  std::vector<Row> fastest;
  for (const MethodReport& method : comparison.methods) {
    Row best{&method, "", nullptr, nullptr};
    const auto look = [&](const std::string& step, const RunRecord& run) {
      if (!run.sound || run.status != "done" || run.time <= 0) return;
      if (best.run == nullptr || run.wall_per_second() < best.run->wall_per_second()) best.run = &run, best.step = step;
    };
    if (method.run) look(method.kind, *method.run);
    for (const TrialReport& trial : method.trials) {
      if (trial.whole) look("fixed", trial.record);
    }
    if (best.run != nullptr) fastest.push_back(best);
  }
  return fastest;
}

double factor_to_first(const Comparison& comparison, const RunRecord& run) {
  if (comparison.methods.empty() || !comparison.methods[0].run) return 0;
  const double first = comparison.methods[0].run->wall_per_second();
  return first > 0 ? run.wall_per_second() / first : 0;
}

std::string comparison_json(const Comparison& comparison) {
  const BuildInfo build = build_info();
  std::vector<std::string> methods;
  for (const MethodReport& method : comparison.methods) methods.push_back(method_json(method));
  JsonObject object(0);
  object.add("scene", comparison.scene_file)
      .add("title", comparison.scene_title)
      .add("end_s", comparison.end)
      .add("interrupted", comparison.interrupted)
      .add("version", build.version)
      .add("compiler", build.compiler)
      .add("processor", processor_name())
      .add("isa", build.isa)
      .add("simd", build.simd)
      .add("real_bits", std::int64_t{build.real_bits})
      .add("threads", std::int64_t{comparison.threads})
      .add("search_dt", comparison.search);
  if (comparison.search) object.add("search_until_s", comparison.search_until);
  object.add("plots_trouble", comparison.plots_trouble).raw("methods", list(methods));
  return object.text() + "\n";
}

std::string comparison_csv(const Comparison& comparison) {
  std::string text = "method,step";
  const RunRecord empty;
  for_each_figure(empty, [&](const char* key, const auto&) { text += fmt::format(",{}", key); });
  text += ",stepping_time_per_simulated_second,factor_to_first,time_to_rest_s";
  for (const Quantity& q : quantities) {
    for (const char* what : {"final", "least", "greatest"}) {
      text += fmt::format(",{}_{}{}", q.key, what, q.unit.empty() ? "" : fmt::format(" [{}]", q.unit));
    }
  }
  text += '\n';
  for (const Row& row : rows_of(comparison)) {
    text += fmt::format("{},{}", csv_field(row.method->name), row.step);
    for_each_figure(*row.run, [&](const char*, const auto& value) {
      text += ',';
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, std::string>) {
        text += csv_field(value);
      } else {
        text += fmt::format("{}", value);
      }
    });
    const Outcome& outcome = *row.outcome;
    text += fmt::format(",{},{},{}", row.run->wall_per_second(), factor_to_first(comparison, *row.run),
                        outcome.time_to_rest ? fmt::format("{}", *outcome.time_to_rest) : "");
    for (const auto& course : outcome.courses) {
      text += course ? fmt::format(",{},{},{}", course->final, course->least, course->greatest) : ",,,";
    }
    text += '\n';
  }
  return text;
}

}  // namespace sessile::app
