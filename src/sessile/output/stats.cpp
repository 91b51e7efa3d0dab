#include "sessile/output/stats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <variant>

namespace sessile {
namespace {

using Cell = std::variant<double, std::int64_t, std::string_view>;

/// A column and what stands in it: names, units and numbers cannot drift apart.
template <class Row>
struct StatsColumn {
  std::string_view name;
  std::string_view unit;
  Cell (*cell)(const Row&);
};

constexpr auto columns = std::to_array<StatsColumn<StatsRow>>({
    {"step", "", [](const StatsRow& r) -> Cell { return r.totals.steps; }},
    {"time", "s", [](const StatsRow& r) -> Cell { return r.time; }},
    {"dt", "s", [](const StatsRow& r) -> Cell { return r.last_step.dt; }},
    {"bound", "", [](const StatsRow& r) -> Cell { return r.last_step.bound; }},
    {"overruled", "", [](const StatsRow& r) -> Cell { return r.last_step.overruled; }},
    {"iterations", "", [](const StatsRow& r) -> Cell { return std::int64_t{r.last_step.iterations}; }},
    {"divergence_iterations", "",
     [](const StatsRow& r) -> Cell { return std::int64_t{r.last_step.divergence_iterations}; }},
    {"predicted_density_error", "", [](const StatsRow& r) -> Cell { return r.last_step.predicted_error; }},
    {"predicted_density_error_max", "", [](const StatsRow& r) -> Cell { return r.last_step.predicted_error_max; }},
    {"density_error", "", [](const StatsRow& r) -> Cell { return r.measured.compression.average; }},
    {"density_error_max", "", [](const StatsRow& r) -> Cell { return r.measured.compression.max; }},
    {"kinetic_energy", "J", [](const StatsRow& r) -> Cell { return r.measured.motion.kinetic_energy; }},
    {"potential_energy", "J", [](const StatsRow& r) -> Cell { return r.measured.motion.potential_energy; }},
    {"work_forces", "J", [](const StatsRow& r) -> Cell { return r.totals.energy.forces; }},
    {"work_pressure", "J", [](const StatsRow& r) -> Cell { return r.totals.energy.pressure; }},
    {"momentum_x", "kg m/s", [](const StatsRow& r) -> Cell { return r.measured.motion.momentum.x; }},
    {"momentum_y", "kg m/s", [](const StatsRow& r) -> Cell { return r.measured.motion.momentum.y; }},
    {"momentum_z", "kg m/s", [](const StatsRow& r) -> Cell { return r.measured.motion.momentum.z; }},
    {"max_speed", "m/s", [](const StatsRow& r) -> Cell { return r.measured.motion.max_speed; }},
    {"particles", "", [](const StatsRow& r) -> Cell { return r.measured.particles; }},
    {"loose", "", [](const StatsRow& r) -> Cell { return r.measured.structure.loose; }},
    {"first_layer", "", [](const StatsRow& r) -> Cell { return r.measured.structure.first_layer; }},
    {"wetted_area", "m^2", [](const StatsRow& r) -> Cell { return r.measured.structure.wetted_area; }},
    {"held", "", [](const StatsRow& r) -> Cell { return r.measured.structure.held; }},
    {"pieces", "", [](const StatsRow& r) -> Cell { return r.measured.structure.pieces; }},
    {"largest_share", "", [](const StatsRow& r) -> Cell { return r.measured.structure.largest_share; }},
    {"nearest_min", "dx", [](const StatsRow& r) -> Cell { return r.measured.structure.nearest_min; }},
    {"nearest_p5", "dx", [](const StatsRow& r) -> Cell { return r.measured.structure.nearest_p5; }},
    {"nearest_median", "dx", [](const StatsRow& r) -> Cell { return r.measured.structure.nearest_median; }},
    {"radius_of_gyration", "m", [](const StatsRow& r) -> Cell { return r.measured.extent.radius_of_gyration; }},
    {"farthest", "m", [](const StatsRow& r) -> Cell { return r.measured.extent.farthest; }},
    {"out", "", [](const StatsRow& r) -> Cell { return r.measured.out; }},
    {"lost", "", [](const StatsRow& r) -> Cell { return r.measured.lost; }},
    {"emitted", "", [](const StatsRow& r) -> Cell { return r.totals.emitted; }},
    {"waits", "", [](const StatsRow& r) -> Cell { return r.totals.waits; }},
    {"unconverged_solves", "", [](const StatsRow& r) -> Cell { return r.totals.unconverged_solves; }},
});

/// Columns that are there when a scene asks for them.
constexpr auto surface_columns = std::to_array<StatsColumn<SurfaceMeasures>>({
    {"surface_area", "m^2", [](const SurfaceMeasures& s) -> Cell { return s.area; }},
    {"surface_volume", "m^3", [](const SurfaceMeasures& s) -> Cell { return s.volume; }},
});

/// Columns that each solid has; its label stands in front.
constexpr auto solid_columns = std::to_array<StatsColumn<SolidForce>>({
    {"force_x", "N", [](const SolidForce& s) -> Cell { return s.force.x; }},
    {"force_y", "N", [](const SolidForce& s) -> Cell { return s.force.y; }},
    {"force_z", "N", [](const SolidForce& s) -> Cell { return s.force.z; }},
    {"torque_x", "N m", [](const SolidForce& s) -> Cell { return s.torque.x; }},
    {"torque_y", "N m", [](const SolidForce& s) -> Cell { return s.torque.y; }},
    {"torque_z", "N m", [](const SolidForce& s) -> Cell { return s.torque.z; }},
});

std::string column_title(std::string_view name, std::string_view unit) {
  return unit.empty() ? std::string(name) : fmt::format("{} [{}]", name, unit);
}

/// Text as one CSV field: quoted when it would not be one otherwise.
std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '\n' || c == '\r') {
      quoted += ' ';  // a line of the file stays a line
    } else {
      quoted.append(c == '"' ? 2 : 1, c);
    }
  }
  return quoted + '"';
}

std::vector<std::string> distinct(std::span<const std::string> labels) {
  std::vector<std::string> names;
  for (const std::string& label : labels) {
    const bool taken = label.empty() || std::find(names.begin(), names.end(), label) != names.end();
    names.push_back(taken ? fmt::format("solid{}", names.size()) : label);
  }
  return names;
}

void append(std::string& line, const Cell& cell) {
  if (!line.empty()) line += ',';
  std::visit([&](const auto& value) { fmt::format_to(std::back_inserter(line), "{}", value); }, cell);
}

}  // namespace

std::string stats_header(std::span<const std::string> solid_labels, bool surface) {
  std::vector<std::string> titles;
  for (const auto& column : columns) titles.push_back(csv_field(column_title(column.name, column.unit)));
  if (surface) {
    for (const auto& column : surface_columns) titles.push_back(column_title(column.name, column.unit));
  }
  for (const std::string& label : distinct(solid_labels)) {
    for (const auto& column : solid_columns) {
      titles.push_back(csv_field(column_title(fmt::format("{}.{}", label, column.name), column.unit)));
    }
  }
  return fmt::format("{}\n", fmt::join(titles, ","));
}

std::string stats_line(const StatsRow& row) {
  std::string line;
  for (const auto& column : columns) append(line, column.cell(row));
  if (row.surface) {
    for (const auto& column : surface_columns) append(line, column.cell(*row.surface));
  }
  for (const SolidForce& solid : row.solids) {
    for (const auto& column : solid_columns) append(line, column.cell(solid));
  }
  return line + '\n';
}

StatsWriter::StatsWriter(const std::filesystem::path& path, std::span<const std::string> solid_labels, bool surface)
    : file_(path) {
  file_.append(stats_header(solid_labels, surface));
}

void StatsWriter::write(const StatsRow& row) { file_.append(stats_line(row)); }

void StatsWriter::write(const Simulation& simulation, const Diagnostics& measured,
                        const std::optional<SurfaceMeasures>& surface) {
  write({simulation.time(), simulation.last_step(), simulation.totals(), measured, simulation.walls().forces, surface});
}

}  // namespace sessile
