#include "shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "sessile/core/error.h"
#include "sessile/scene/spelling.h"
#include "sessile/simulation.h"

namespace sessile::app {
namespace {

/// Grows a box by a corner.
class Box {
 public:
  void add(const Vec3d& p) {
    low_ = empty_ ? p : Vec3d{std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
    high_ = empty_ ? p : Vec3d{std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    empty_ = false;
  }

  /// The corners of a box of that size in the axes of a placement; `centre` is in them as well.
  void add(const Placement& placement, const Vec3d& size, const Vec3d& centre = {}) {
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        for (const double z : {-0.5, 0.5}) add(placement.to_world(centre + Vec3d{x * size.x, y * size.y, z * size.z}));
      }
    }
  }

  bool empty() const { return empty_; }
  const Vec3d& low() const { return low_; }
  const Vec3d& high() const { return high_; }

 private:
  Vec3d low_{}, high_{};
  bool empty_ = true;
};

void add_shape(Box& box, const Placement& at, const sessile::Box& shape) { box.add(at, shape.size); }
void add_shape(Box& box, const Placement& at, const Sphere& shape) {
  box.add(Placement{at.position}, 2 * shape.radius * Vec3d{1, 1, 1});
}
void add_shape(Box& box, const Placement& at, const Cylinder& shape) {
  box.add(at, {2 * shape.radius, 2 * shape.radius, shape.height});
}
void add_shape(Box& box, const Placement& at, const Mesh& shape) {
  const TriangleMesh mesh = load_mesh(shape);
  box.add(at, mesh.upper() - mesh.lower(), 0.5 * (mesh.upper() + mesh.lower()));
}
void add_shape(Box& box, const Placement& at, const Rectangle& shape) { box.add(at, {shape.width, shape.depth, 0}); }
void add_shape(Box& box, const Placement& at, const Disc& shape) {
  box.add(at, {2 * shape.radius, 2 * shape.radius, 0});
}

const Column* find_column(const Snapshot& frame, std::string_view name) {
  for (const Column& column : frame.columns) {
    if (column.name == name) return &column;
  }
  return nullptr;
}

/// One number a particle: of a vector its length.
std::vector<float> sizes(const Column& column) {
  const auto width = static_cast<std::size_t>(column.components);
  return std::visit(
      [&](const auto& numbers) {
        std::vector<float> values;
        values.reserve(numbers.size() / width);
        for (std::size_t k = 0; k + width <= numbers.size(); k += width) {
          double sum = 0;
          for (std::size_t c = 0; c < width; ++c) sum += std::pow(static_cast<double>(numbers[k + c]), 2);
          values.push_back(width == 1 ? static_cast<float>(numbers[k]) : static_cast<float>(std::sqrt(sum)));
        }
        return values;
      },
      column.values);
}

std::vector<float> heights(const std::vector<float>& points, const Vec3d& up) {
  std::vector<float> values;
  for (std::size_t k = 0; k + 2 < points.size(); k += 3) {
    values.push_back(static_cast<float>(dot(Vec3d{points[k], points[k + 1], points[k + 2]}, up)));
  }
  return values;
}

Error unknown_field(std::string_view name, const std::vector<std::string>& there) {
  const std::vector<std::string_view> names(there.begin(), there.end());
  return Error(fmt::format("there is no field {}{}", in_quotes(name), spelling_hint(name, names, "fields here")));
}

}  // namespace

draw::Stage stage_of(const Scene& scene) {
  draw::Stage stage;
  stage.spacing = scene.spacing;
  const double gravity = length(scene.gravity);
  stage.weightless = !(gravity > 0);
  if (gravity > 0) stage.up = -1 / gravity * scene.gravity;
  stage.solids = solid_meshes(scene);
  // A thousandth of the run is told apart, and hundredths of a second always.
  stage.time_decimals = std::clamp(3 - static_cast<int>(std::ceil(std::log10(scene.time.end))), 2, 9);
  Box box;
  for (const SolidMesh& solid : stage.solids) {
    for (const Vec3d& p : solid.mesh.vertices) box.add(p);
  }
  for (const Body& body : scene.bodies)
    std::visit([&](const auto& s) { add_shape(box, body.placement, s); }, body.shape);
  for (const Emitter& emitter : scene.emitters) {
    std::visit([&](const auto& s) { add_shape(box, emitter.placement, s); }, emitter.shape);
  }
  if (const auto& domain = scene.domain; domain && domain->x == Edge::closed && domain->y == Edge::closed) {
    box.add(domain->min);  // a basin: its walls are not drawn, and the liquid will fill its width
    box.add({domain->max.x, domain->max.y, box.empty() ? domain->max.z : box.high().z});
  }
  const Vec3d margin = 0.5 * scene.spacing * Vec3d{1, 1, 1};
  stage.low = box.low() - margin;
  stage.high = box.high() + margin;
  return stage;
}

std::vector<std::string> shown_fields(const Snapshot& frame) {
  std::vector<std::string> names;
  if (find_column(frame, "velocity") != nullptr) names.emplace_back("speed");
  names.emplace_back("height");
  for (const Column& column : frame.columns) {
    if (std::find(names.begin(), names.end(), column.name) == names.end()) names.push_back(column.name);
  }
  return names;
}

std::vector<std::string> shown_fields(const Simulation& simulation) {
  std::vector<std::string> names{"speed", "height"};
  for (const KnownColumn& column : known_columns()) {
    if (!column.name.starts_with(acceleration_prefix) && column.name != "speed") names.emplace_back(column.name);
  }
  for (const std::string& force : simulation.acceleration_names()) {
    names.push_back(fmt::format("{}{}", acceleration_prefix, force));
  }
  return names;
}

draw::Moment moment_of(const Snapshot& frame, std::string_view field, const draw::Stage& stage) {
  draw::Moment moment;
  moment.time = frame.time;
  moment.time_decimals = stage.time_decimals;
  moment.points = frame.points;
  const Column* column = find_column(frame, field == "speed" || field.empty() ? "velocity" : field);
  if (const Column* own = find_column(frame, field); own != nullptr) column = own;
  if (column == nullptr && field.empty() && !frame.columns.empty()) column = &frame.columns.front();
  if (column != nullptr) {
    moment.values = sizes(*column);
    moment.field = column->name == "velocity" ? "speed" : column->name;
    moment.unit = column->unit;
  } else if (field == "height") {
    moment.values = heights(frame.points, stage.up);
    moment.field = "height";
    moment.unit = std::string("m");  // GCC 12 warns of the plain literal
  } else if (!field.empty()) {
    throw unknown_field(field, shown_fields(frame));
  }
  return moment;
}

draw::Moment moment_of(const Simulation& simulation, std::string_view field, const draw::Stage& stage) {
  std::vector<std::string> columns;
  if (field.empty() || field == "speed") {
    columns.emplace_back("velocity");
  } else if (field != "height") {
    const std::vector<std::string> there = shown_fields(simulation);
    if (std::find(there.begin(), there.end(), field) == there.end()) throw unknown_field(field, there);
    columns.emplace_back(field);
  }
  return moment_of(take_snapshot(simulation, columns), field, stage);
}

}  // namespace sessile::app
