#include "plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "gnuplot.h"
#include "outcome.h"
#include "sessile/output/file.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

// Okabe and Ito's colours, which people with any colour vision can tell apart; yellow left out: it is pale on white.
constexpr std::array<std::string_view, 7> colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                  "#E69F00", "#56B4E9", "#000000"};

/// A text in gnuplot's single quotes, where nothing but the quote itself is special.
std::string literal(std::string_view text) {
  std::string result = "'";
  for (const char c : text) result.append(c == '\'' ? 2 : 1, c);
  result += '\'';
  return result;
}

/// Earlier lines are wider, so that they show beneath later ones that run along them.
double width(std::size_t i) { return std::max(1.6, 3.6 - 0.3 * static_cast<double>(i)); }

/// Whether any method has the column at all: some are there only where a scene asks for them.
bool any_values(const std::vector<StatsTable>& tables, const Plot& plot) {
  return std::any_of(tables.begin(), tables.end(),
                     [&](const StatsTable& table) { return !table.column(std::string(plot.column)).empty(); });
}

/// Whether any method has a value that a logarithmic axis can show.
bool any_positive(const std::vector<StatsTable>& tables, const Plot& plot) {
  return std::any_of(tables.begin(), tables.end(), [&](const StatsTable& table) {
    const auto& values = table.column(std::string(plot.column));
    return std::any_of(values.begin(), values.end(), [](double value) { return value > 0; });
  });
}

std::string axis(const Plot& plot, bool logarithmic) {
  std::string text = fmt::format("set title {}\nset ylabel {}\n", literal(plot.title), literal(plot.axis));
  if (logarithmic) return text + "set logscale y\nset format y '10^{%L}'\nset yrange [*:*]\nset offsets 0, 0, 0, 0\n";
  return text + fmt::format("unset logscale y\nset format y '%g'\nset yrange [{}:*]\nset offsets 0, 0, graph 0.05, 0\n",
                            plot.from_zero ? "0" : "*");
}

}  // namespace

std::string plot_script(const fs::path& folder, const std::vector<std::string>& methods) {
  std::string script =
      "# Draws the plots of the comparison, each as PNG and SVG, from the methods' stats.csv:\n"
      "#   gnuplot comparison.gp\n"
      "# in this folder. `sessile compare` writes it anew whenever it runs.\n\n"
      "set datafile separator ','\nset datafile missing 'nan'\n"
      "set border 3 lc rgb '#555555'\nset tics nomirror textcolor rgb '#333333'\n"
      "set grid lt 1 lw 1 lc rgb '#dddddd'\n"
      "set key outside right top Left reverse samplen 2 spacing 1.3 noenhanced\n"
      "set title font ',18' noenhanced\nset ylabel noenhanced\nset xlabel 'simulated time [s]'\nset xrange [0:*]\nset "
      "autoscale xfixmax\nset format x '%g'\n\n";
  std::vector<StatsTable> tables;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    tables.emplace_back(folder / methods[i] / "stats.csv");
    script += fmt::format("name{0} = {1}\nfile{0} = {2}\nset style line {0} lw {5:.1f} lc rgb '{3}' dashtype {4}\n",
                          i + 1, literal(methods[i]), literal(fmt::format("../{}/stats.csv", methods[i])),
                          colours[i % colours.size()], 1 + i / colours.size(), width(i));
  }
  for (const Plot& plot : plots) {
    if (!any_values(tables, plot)) continue;
    script += '\n';
    script += axis(plot, plot.logarithmic && any_positive(tables, plot));
    std::string lines;
    for (std::size_t i = 1; i <= methods.size(); ++i) {
      const std::string value = plot.of_steps ? fmt::format("(column('step') > 0 ? column('{}') : NaN)", plot.column)
                                              : fmt::format("(column('{}'))", plot.column);
      lines += fmt::format("{}file{} using (column('time [s]')):{} with lines ls {} title name{}",
                           lines.empty() ? "" : ", \\\n     ", i, value, i, i);
    }
    script += fmt::format(
        "set terminal pngcairo size 1200,700 font 'DejaVu Sans,14' background '#ffffff'\n"
        "set output '{0}.png'\nplot {1}\n"
        "set terminal svg size 1200,700 font 'DejaVu Sans,14' background '#ffffff'\n"
        "set output '{0}.svg'\nreplot\nunset output\n",
        plot.key, lines);
  }
  return script;
}

std::string draw_plots(const fs::path& folder, const std::vector<std::string>& methods) {
  const fs::path place = folder / "plots";
  create_output_folder(place);
  std::error_code ignored;
  for (const Plot& plot : plots) {  // none of an earlier call may pass for one of this
    for (const char* kind : {".png", ".svg"}) fs::remove(place / (std::string(plot.key) + kind), ignored);
  }
  write_whole(place / "comparison.gp", plot_script(folder, methods));
  const fs::path log = place / "gnuplot.log";
  const GnuplotEnd end = run_gnuplot(place, "comparison.gp", log);
  if (end == GnuplotEnd::missing) {
    return "there are no plots: gnuplot is not installed; it is in Debian's package gnuplot-nox";
  }
  if (end == GnuplotEnd::failed) return fmt::format("gnuplot failed; {} says why", log.string());
  fs::remove(log, ignored);
  return {};
}

}  // namespace sessile::app
