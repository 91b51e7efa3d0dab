#include "view/moments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace sessile::viewer {
namespace {

/// One number a particle: lengths of vectors.
std::vector<float> numbers(const Column& column) {
  const auto width = static_cast<std::size_t>(column.components);
  return std::visit(
      [&](const auto& from) {
        std::vector<float> values(from.size() / width);
        for (std::size_t i = 0; i < values.size(); ++i) {
          float squares = 0;
          for (std::size_t c = 0; c < width; ++c) {
            const auto x = static_cast<float>(from[width * i + c]);
            squares += x * x;
          }
          values[i] = width == 1 ? static_cast<float>(from[i]) : std::sqrt(squares);
        }
        return values;
      },
      column.values);
}

const Column* find(const Snapshot& snapshot, const std::string& name) {
  const auto found =
      std::find_if(snapshot.columns.begin(), snapshot.columns.end(), [&](const Column& c) { return c.name == name; });
  return found == snapshot.columns.end() ? nullptr : &*found;
}

void colour(draw::Moment& moment, const Column& column, const std::string& field) {
  moment.values = numbers(column);
  moment.field = field;
  moment.unit = column.unit;
}

}  // namespace

draw::Moment moment_of(const Simulation& simulation, const std::string& field) {
  draw::Moment moment;
  moment.time = simulation.time();
  moment.points = interleaved(simulation.particles().position);
  if (const auto column = plain_column(simulation, field)) {
    colour(moment, *column, field);
  } else if (field.starts_with(acceleration_prefix)) {
    const std::string force = field.substr(acceleration_prefix.size());
    const auto names = simulation.acceleration_names();
    if (std::find(names.begin(), names.end(), force) != names.end()) {
      colour(moment, {field, "m/s^2", 3, interleaved(simulation.acceleration(force))}, field);
    }
  }
  return moment;
}

draw::Moment moment_of(const Snapshot& snapshot, const std::string& field) {
  draw::Moment moment;
  moment.time = snapshot.time;
  moment.points = snapshot.points;
  const Column* column = find(snapshot, field);
  if (column == nullptr && field == "speed") column = find(snapshot, "velocity");
  if (column != nullptr) colour(moment, *column, field);
  return moment;
}

Snapshot coloured_points(const draw::Moment& moment) {
  Snapshot snapshot{moment.time, 0, moment.points, {}};
  if (!moment.values.empty()) snapshot.columns.push_back({moment.field, moment.unit, 1, moment.values});
  return snapshot;
}

draw::Stage stage_of(const Scene& scene, const std::vector<float>& points) {
  draw::Stage stage;
  stage.spacing = scene.spacing;
  if (const double g = length(scene.gravity); g > 0) stage.up = (-1 / g) * scene.gravity;
  stage.solids = solid_meshes(scene);
  const double most = std::numeric_limits<double>::infinity();
  Vec3d low{most, most, most}, high{-most, -most, -most};
  const auto hold = [&](const Vec3d& x) {
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  };
  for (std::size_t k = 0; k + 2 < points.size(); k += 3) {
    hold({static_cast<double>(points[k]), static_cast<double>(points[k + 1]), static_cast<double>(points[k + 2])});
  }
  for (const SolidMesh& solid : stage.solids) {
    for (const Vec3d& vertex : solid.mesh.vertices) hold(vertex);
  }
  for (const Emitter& emitter : scene.emitters) hold(emitter.placement.position);
  const Vec3d margin = Vec3d{1, 1, 1} * (0.5 * scene.spacing);
  stage.low = low - margin;
  stage.high = high + margin;
  return stage;
}

std::vector<std::string> fields_of(const Snapshot& snapshot) {
  std::vector<std::string> names;
  if (find(snapshot, "speed") == nullptr && find(snapshot, "velocity") != nullptr) names.emplace_back("speed");
  for (const Column& column : snapshot.columns) names.push_back(column.name);
  return names;
}

std::vector<std::string> fields_of(const std::vector<std::string>& accelerations) {
  std::vector<std::string> names;
  for (const KnownColumn& known : known_columns()) {
    if (!known.name.starts_with(acceleration_prefix)) names.emplace_back(known.name);
  }
  for (const std::string& each : accelerations) names.push_back(std::string(acceleration_prefix) + each);
  return names;
}

}  // namespace sessile::viewer
