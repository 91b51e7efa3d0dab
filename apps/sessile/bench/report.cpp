#include "bench/report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <omp.h>

#include <cmath>
#include <ctime>
#include <utility>

#include "machine.h"
#include "say.h"
#include "sessile/output/json_object.h"
#include "sessile/version.h"

namespace sessile::app::bench {
namespace {

/// Four figures, all of those before the point.
std::string number(double value) {
  const double size = std::abs(value);
  if (size >= 1000) return fmt::format("{:.0f}", value);
  if (size >= 100) return fmt::format("{:.1f}", value);
  if (size >= 10) return fmt::format("{:.2f}", value);
  return fmt::format("{:.4g}", value);
}

std::string list(const std::vector<std::string>& entries) { return fmt::format("[{}]", fmt::join(entries, ", ")); }

std::string figure_json(const Figure& figure, bool goals) {
  std::vector<std::string> samples;
  for (const double sample : figure.samples) samples.push_back(fmt::format("{}", sample));
  JsonObject object(2);
  object.add("key", figure.key)
      .add("what", figure.what)
      .add("unit", figure.unit)
      .add("median", figure.median())
      .add("min", figure.least())
      .add("max", figure.greatest())
      .raw("samples", list(samples));
  const auto goal = goals ? goal_for(figure.key) : std::nullopt;
  if (goal) object.add("goal", goal->goal).add("moonshot", goal->moonshot);
  if (figure.neighbors) object.add("neighbors", *figure.neighbors);
  if (figure.bound) {
    object.add("bound", figure.bound->value)
        .add("bound_by", figure.bound->by)
        .add("share", figure.bound->value / figure.median());
  }
  return object.text();
}

}  // namespace

void Report::section(const std::string& title) {
  say(stdout, fmt::format("\n{:<58}{:>8}{:>10}{:>10}   {:<20}  {}\n", title, goals_ ? "goal" : "",
                          goals_ ? "moonshot" : "", "median", "least .. greatest", "unit"));
}

void Report::add(Figure figure) {
  const auto goal = goals_ ? goal_for(figure.key) : std::nullopt;
  std::string line = fmt::format("  {:<56}{:>8}{:>10}{:>10}   {:<20}  {}", figure.what, goal ? number(goal->goal) : "",
                                 goal ? number(goal->moonshot) : "", number(figure.median()),
                                 number(figure.least()) + " .. " + number(figure.greatest()), figure.unit);
  if (figure.bound) {
    line += fmt::format("; {:.0f} % of what {} allow{}", 100 * figure.bound->value / figure.median(), figure.bound->by,
                        figure.bound->by == "gathers" ? "" : "s");
  }
  say(stdout, line + "\n");
  figures_.push_back(std::move(figure));
}

void Report::remark(const std::string& sentence) {
  say(stdout, fmt::format("  {}\n", sentence));
  remarks_.push_back(sentence);
}

std::string report_json(const Report& report) {
  const BuildInfo build = build_info();
  JsonObject machine(1);
  machine.add("processor", processor_name())
      .add("threads", std::int64_t{omp_get_max_threads()})
      .add("simd", build.simd)
      .add("lanes", std::int64_t{build.lanes});
  JsonObject program(1);
  program.add("version", build.version)
      .add("compiler", build.compiler)
      .add("build", build.type)
      .add("real_bits", std::int64_t{build.real_bits});
  std::vector<std::string> figures;
  for (const Figure& figure : report.figures()) figures.push_back(figure_json(figure, report.goals()));
  JsonObject all(0);
  all.add("date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))))
      .raw("machine", machine.text())
      .raw("program", program.text())
      .raw("figures", fmt::format("[\n    {}\n  ]", fmt::join(figures, ",\n    ")));
  std::string joined;
  for (const std::string& remark : report.remarks()) joined += (joined.empty() ? "" : " ") + remark;
  all.add("remarks", joined);
  return all.text() + "\n";
}

}  // namespace sessile::app::bench
