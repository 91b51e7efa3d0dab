#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

#include "comparison.h"
#include "machine.h"
#include "plots.h"
#include "sessile/version.h"

namespace sessile::app {
namespace {

/// Text in a cell of a table.
std::string cell(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '|' || c == '\\' || c == '_' || c == '*' || c == '`' || c == '<' || c == '[' || c == ']') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

/// A part of an address in a link.
std::string address(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                       c == '_' || c == '.' || c == '/';
    result += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return result;
}

std::string seconds(double value) {
  if (value < 10) return fmt::format("{:.2f} s", value);
  if (value < 600) return fmt::format("{:.1f} s", value);
  const auto whole = std::llround(value);
  if (whole < 36000) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }
std::string milliseconds(double value) { return fmt::format("{:.3g} ms", 1e3 * value); }

/// A number with up to four figures; counts in full.
std::string number(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e9) return fmt::format("{:.0f}", value);
  return fmt::format("{:.4g}", value);
}

std::string table_line(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

std::string table_head(const std::vector<std::string>& titles, std::size_t words) {
  std::vector<std::string> rules;
  for (std::size_t i = 0; i < titles.size(); ++i) rules.emplace_back(i < words ? "---" : "---:");
  return table_line(titles) + table_line(rules);
}

/// "-" where the first method took no time: it failed at once.
std::string factor(const Comparison& comparison, const RunRecord& run) {
  const double value = factor_to_first(comparison, run);
  return value > 0 ? fmt::format("{:.2f}", value) : "-";
}

/// Those of the divergence solve behind a plus, where there is one.
std::string iterations(const RunRecord& run) {
  std::string text = fmt::format("{:.1f}", run.iterations_per_step);
  if (run.divergence_iterations == 0 || run.steps == 0) return text;
  return text +
         fmt::format(" + {:.1f}", static_cast<double>(run.divergence_iterations) / static_cast<double>(run.steps));
}

std::string soundness(const RunRecord& run) {
  if (run.status == "interrupted") return "interrupted";
  if (run.status == "failed") return "**failed**";
  return run.sound ? "sound" : "**unsound**";
}

std::string head(const Comparison& comparison) {
  const BuildInfo build = build_info();
  std::string text = fmt::format("# Comparison of methods: {}\n\n",
                                 cell(comparison.scene_title.empty() ? comparison.scene_file : comparison.scene_title));
  if (comparison.interrupted)
    text += "**Interrupted: this is what was done until then.** The same command goes on.\n\n";
  text += fmt::format("- scene: `{}`, {:g} s\n", comparison.scene_file, comparison.end);
  for (const MethodReport& method : comparison.methods) {
    if (!method.run) continue;
    text += fmt::format("- {} particles at the end of the first run, {} boundary particles\n", method.run->particles,
                        method.run->wall_particles);
    break;
  }
  text += fmt::format("- sessile {}, {}, {}-bit numbers, {} with {} lanes\n", build.version, build.compiler,
                      build.real_bits, build.simd, build.lanes);
  text += fmt::format("- {} threads on {}\n\n", comparison.threads, processor_name());
  text += table_head({"method", "what it is", "file"}, 3);
  for (const MethodReport& method : comparison.methods) {
    text += table_line({cell(method.name), cell(method.title), "`" + method.file + "`"});
  }
  return text + "\n";
}

std::string runs_table(const Comparison& comparison) {
  std::string text =
      "## Runs\n\nTimes are of the steps alone, without output and measures; `total` has those too. `factor` is the "
      "time per "
      "simulated second over that of the first method. The density error is the average compression over rest density, "
      "its "
      "mean over all steps and that of the worst step: at the new positions, and as the solver had predicted it.\n\n";
  text += table_head(
      {"method", "step", "verdict", "time", "total", "per simulated s", "factor", "steps", "mean dt", "least dt",
       "greatest dt", "iterations a step", "density error", "worst", "predicted", "worst", "work of pressure"},
      3);
  for (const Row& row : rows_of(comparison)) {
    const RunRecord& run = *row.run;
    text += table_line({cell(row.method->name), row.step, soundness(run), seconds(run.stepping), seconds(run.wall),
                        seconds(run.wall_per_second()), factor(comparison, run), fmt::format("{}", run.steps),
                        milliseconds(run.dt_mean), milliseconds(run.dt_least), milliseconds(run.dt_greatest),
                        iterations(run), percent(run.density_error), percent(run.density_error_max),
                        percent(run.predicted_error), percent(run.predicted_error_max),
                        fmt::format("{:.3g} J", run.energy.pressure)});
  }
  text += "\n";
  for (const Row& row : rows_of(comparison)) {
    if (row.run->sound || row.run->status == "interrupted") continue;
    text += fmt::format("- **{}**, {}: at {:.4g} s {}\n", cell(row.method->name), row.step, row.run->verdict_time,
                        cell(row.run->reason));
  }
  for (const MethodReport& method : comparison.methods) {
    if (!method.run) text += fmt::format("- **{}** was not reached\n", cell(method.name));
    if (method.run && method.run->status == "interrupted") {
      text += fmt::format("- **{}** was interrupted at {:.4g} s\n", cell(method.name), method.run->time);
    }
  }
  return text + "\n";
}

std::string fastest_table(const Comparison& comparison) {
  const std::vector<Row> rows = fastest_sound(comparison);
  if (rows.empty()) return {};
  const Row& first = rows.front();
  std::string text =
      fmt::format("## Fastest sound run of each method\n\n`speed` is over that of {}.\n\n", cell(first.method->name));
  text += table_head(
      {"method", "step", "mean dt", "iterations a step", "density error", "time per simulated s", "speed"}, 2);
  for (const Row& row : rows) {
    text += table_line({cell(row.method->name), row.step, milliseconds(row.run->dt_mean), iterations(*row.run),
                        percent(row.run->density_error), seconds(row.run->wall_per_second()),
                        fmt::format("{:.2f}", first.run->wall_per_second() / row.run->wall_per_second())});
  }
  return text + "\n";
}

std::string outcome_table(const Comparison& comparison) {
  std::vector<Row> rows;
  for (const Row& row : rows_of(comparison)) {
    if (row.outcome->known) rows.push_back(row);
  }
  if (rows.empty()) return {};
  std::string text =
      "## What became of the liquid\n\nFinal value, and in brackets the greatest of the run, or the least where "
      "`least` "
      "stands. Time to rest: from then on the kinetic energy stays below a 10000th of its peak.\n\n";
  std::vector<std::string> titles{"quantity"};
  for (const Row& row : rows)
    titles.push_back(cell(row.method->name) + (row.step == "adaptive" ? "" : ", " + row.step));
  text += table_head(titles, 1);
  std::vector<std::string> line{"time to rest"};
  for (const Row& row : rows) {
    line.push_back(row.outcome->time_to_rest ? fmt::format("{:.4g} s", *row.outcome->time_to_rest) : "not reached");
  }
  text += table_line(line);
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const Quantity& q = quantities[i];
    std::string title(q.title);
    if (!q.unit.empty()) title += fmt::format(" [{}]", q.unit);
    if (q.least) title += ", least";
    line = {title};
    bool any = false;
    for (const Row& row : rows) {
      const auto& course = row.outcome->courses[i];
      any = any || course;
      line.push_back(
          course ? fmt::format("{} ({})", number(course->final), number(q.least ? course->least : course->greatest))
                 : "");
    }
    if (any) text += table_line(line);
  }
  return text + "\n";
}

std::string search_tables(const Comparison& comparison) {
  if (!comparison.search) return {};
  std::string text = fmt::format(
      "## Largest sound step\n\nFixed steps from a series of ten a decade, run to {:g} s. A trial ends as soon as it "
      "is "
      "unsound.\n\n",
      comparison.search_until);
  for (const MethodReport& method : comparison.methods) {
    const std::string result = method.largest    ? milliseconds(method.largest->dt)
                               : method.searched ? "none of the series"
                                                 : "the search was not finished";
    text += fmt::format("### {}: {}\n\n", cell(method.name), result);
    if (method.trials.empty()) continue;
    text += table_head({"step", "to", "verdict", "at", "why", "time"}, 5);
    for (const TrialReport& trial : method.trials) {
      const RunRecord& run = trial.record;
      text += table_line({fmt::format("[{}]({})", milliseconds(trial.dt), address(trial.folder)),
                          fmt::format("{:g} s", trial.whole ? comparison.end : comparison.search_until), soundness(run),
                          fmt::format("{:.4g} s", run.verdict_time), cell(run.reason), seconds(run.stepping)});
    }
    text += "\n";
  }
  return text;
}

std::string plots_section(const Comparison& comparison) {
  std::string text = "## Over simulated time\n\n";
  if (!comparison.plots_trouble.empty()) return text + fmt::format("{}.\n", comparison.plots_trouble);
  for (const Plot& plot : plots) {
    // Not every scene asks for every column.
    if (!std::filesystem::exists(comparison.folder / "plots" / (std::string(plot.key) + ".png"))) continue;
    text += fmt::format("![{0}](plots/{1}.png)\n\n[{0} as SVG](plots/{1}.svg)\n\n", plot.title, plot.key);
  }
  return text + "`plots/comparison.gp` draws them; change it and run `gnuplot comparison.gp` there.\n";
}

}  // namespace

std::string comparison_markdown(const Comparison& comparison) {
  std::string text = head(comparison) + runs_table(comparison) + fastest_table(comparison) + outcome_table(comparison) +
                     search_tables(comparison);
  return text + plots_section(comparison);
}

}  // namespace sessile::app
