#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <variant>

#include "sessile/scene/frame.h"
#include "sessile/scene/lattice.h"
#include "sessile/scene/mesh_sampling.h"
#include "sessile/scene/sampling.h"
#include "sessile/scene/traits.h"

namespace sessile {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double long_side = 100;  // over the spacing: up to here the area tells enough
constexpr double thinnest = 0.25;  // over the spacing: a further layer of less radius or height would fall together

/// What every sampler is told.
struct Request {
  double spacing;
  int layers;
  std::string who;
};

/// Steps along an edge, at least one, so that its two ends are always samples.
double edge_steps(double length, double spacing) { return std::max(1.0, steps_in(length, spacing)); }

/// The outermost `layers` shells of a lattice that fills a box from face to face. `grown` shells lie outside the box.
std::vector<Vec3d> box_shells(const Vec3d& size, const Request& request, int grown) {
  const std::array<double, 3> fits{edge_steps(size.x, request.spacing), edge_steps(size.y, request.spacing),
                                   edge_steps(size.z, request.spacing)};
  const Vec3d step{size.x / fits[0], size.y / fits[1], size.z / fits[2]};
  std::array<double, 3> points{};
  for (std::size_t k = 0; k < 3; ++k) points[k] = fits[k] + 1 + 2.0 * grown;
  // No difference of two products: where these are huge nothing would be left of it.
  const double whole = points[0] * points[1] * points[2];
  const double shells = 2.0 * request.layers * (points[0] * points[1] + points[1] * points[2] + points[2] * points[0]);
  check_count(std::min(whole, shells), request.who);

  const std::array<std::int64_t, 3> n{static_cast<std::int64_t>(points[0]), static_cast<std::int64_t>(points[1]),
                                      static_cast<std::int64_t>(points[2])};
  const auto in_shell = [&](std::int64_t i, std::int64_t count) { return std::min(i, count - 1 - i) < request.layers; };
  std::vector<Vec3d> samples;
  for (std::int64_t k = 0; k < n[2]; ++k) {
    for (std::int64_t j = 0; j < n[1]; ++j) {
      const bool whole_row = in_shell(k, n[2]) || in_shell(j, n[1]);
      for (std::int64_t i = 0; i < n[0]; ++i) {
        // A row through the hollow has samples at its ends only.
        if (!whole_row && !in_shell(i, n[0])) i = n[0] - request.layers;
        samples.push_back(
            {centred_place(i, n[0], step.x), centred_place(j, n[1], step.y), centred_place(k, n[2], step.z)});
      }
    }
  }
  return samples;
}

std::vector<Vec3d> sample_shape(const Box& box, const Request& request) { return box_shells(box.size, request, 0); }

std::vector<Vec3d> sample_shape(const Container& container, const Request& request) {
  return box_shells(container.size, request, request.layers - 1);
}

std::vector<Vec3d> sample_shape(const Plate& plate, const Request& request) {
  const double fit_x = edge_steps(plate.width, request.spacing), fit_y = edge_steps(plate.depth, request.spacing);
  check_count((fit_x + 1) * (fit_y + 1) * request.layers, request.who);
  const auto nx = static_cast<std::int64_t>(fit_x) + 1, ny = static_cast<std::int64_t>(fit_y) + 1;
  std::vector<Vec3d> samples;
  for (int k = 0; k < request.layers; ++k) {
    for (std::int64_t j = 0; j < ny; ++j) {
      for (std::int64_t i = 0; i < nx; ++i) {
        samples.push_back({centred_place(i, nx, plate.width / fit_x), centred_place(j, ny, plate.depth / fit_y),
                           -k * request.spacing});
      }
    }
  }
  return samples;
}

/// A spiral from pole to pole that turns by the golden angle: as even as a sphere allows.
std::vector<Vec3d> sample_shape(const Sphere& sphere, const Request& request) {
  const double golden = pi * (3 - std::sqrt(5.0));
  std::vector<Vec3d> samples;
  for (int k = 0; k < request.layers; ++k) {
    const double radius = sphere.radius - k * request.spacing;
    if (k > 0 && radius < thinnest * request.spacing) break;
    const double relative = radius / request.spacing;
    const double fit = std::max(1.0, std::round(4 * pi * relative * relative));
    check_count(fit * request.layers, request.who);
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(fit); ++i) {
      const double z = 1 - (2 * static_cast<double>(i) + 1) / fit;
      const double ring = std::sqrt(1 - z * z), angle = static_cast<double>(i) * golden;
      samples.push_back(radius * Vec3d{ring * std::cos(angle), ring * std::sin(angle), z});
    }
  }
  return samples;
}

void add_ring(std::vector<Vec3d>& samples, double radius, double z, double spacing, bool shifted) {
  const double fit = std::max(1.0, std::round(2 * pi * radius / spacing));
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(fit); ++i) {
    const double angle = 2 * pi * (static_cast<double>(i) + (shifted ? 0.5 : 0)) / fit;
    samples.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
  }
}

/// Rings along the side and, closing it, rings within rings on both ends.
std::vector<Vec3d> sample_shape(const Cylinder& cylinder, const Request& request) {
  std::vector<Vec3d> samples;
  for (int k = 0; k < request.layers; ++k) {
    const double radius = cylinder.radius - k * request.spacing, height = cylinder.height - 2 * k * request.spacing;
    if (k > 0 && std::min(radius, height) < thinnest * request.spacing) break;
    const double levels = edge_steps(height, request.spacing), circles = edge_steps(radius, request.spacing);
    const double around = 2 * pi * radius / request.spacing;
    // A ring has a sample at least, however thin the cylinder is.
    check_count((around + 1) * (levels + 1 + 2 * circles) * request.layers, request.who);
    for (std::int64_t i = 0; i <= static_cast<std::int64_t>(levels); ++i) {
      const double z = centred_place(i, static_cast<std::int64_t>(levels) + 1, height / levels);
      add_ring(samples, radius, z, request.spacing, i % 2 == 1);
    }
    for (std::int64_t j = 0; j < static_cast<std::int64_t>(circles); ++j) {
      const double within = radius * static_cast<double>(j) / circles;
      for (const double z : {-height / 2, height / 2}) add_ring(samples, within, z, request.spacing, j % 2 == 1);
    }
  }
  return samples;
}

std::vector<Vec3d> sample_shape(const Mesh& mesh, const Request& request) {
  return sample_mesh(load_mesh(mesh), request.spacing, request.layers, request.who);
}

/// Samples along what is longer than `long_side` spacings, each: what the area leaves out of needles.
double along(double length, double spacing) { return std::max(0.0, length / spacing - long_side); }

double needles(const SolidShape& solid_shape, double spacing) {
  return std::visit(
      [&]<Named T>(const T& shape) {
        if constexpr (std::is_same_v<T, Box> || std::is_same_v<T, Container>) {
          return along(std::max({shape.size.x, shape.size.y, shape.size.z}), spacing);
        } else if constexpr (std::is_same_v<T, Plate>) {
          return along(std::max(shape.width, shape.depth), spacing);
        } else if constexpr (std::is_same_v<T, Cylinder>) {
          return along(std::max(shape.radius, shape.height), spacing);
        } else {
          return 0.0;  // a mesh adds its own
        }
      },
      solid_shape);
}

double area(const SolidShape& solid_shape) {
  return std::visit(
      []<Named T>(const T& shape) {
        if constexpr (std::is_same_v<T, Box> || std::is_same_v<T, Container>) {
          return 2 * (shape.size.x * shape.size.y + shape.size.y * shape.size.z + shape.size.z * shape.size.x);
        } else if constexpr (std::is_same_v<T, Plate>) {
          return shape.width * shape.depth;
        } else if constexpr (std::is_same_v<T, Sphere>) {
          return 4 * pi * shape.radius * shape.radius;
        } else if constexpr (std::is_same_v<T, Cylinder>) {
          return 2 * pi * shape.radius * (shape.radius + shape.height);
        } else {
          return 0.0;  // a mesh is counted by estimate_mesh()
        }
      },
      solid_shape);
}

}  // namespace

std::vector<Vec3d> sample_surface(const Solid& solid, double spacing) {
  const Request request{solid.spacing.value_or(spacing), solid.layers,
                        called("solid", solid.label, name_of(solid.shape))};
  auto samples = std::visit([&](const auto& shape) { return sample_shape(shape, request); }, solid.shape);
  const Frame frame(solid.placement);
  for (auto& sample : samples) sample = frame.to_world(sample);
  return samples;
}

double estimate_surface(const Solid& solid, double spacing) {
  const double distance = solid.spacing.value_or(spacing);
  if (const auto* mesh = std::get_if<Mesh>(&solid.shape))
    return solid.layers * estimate_mesh(load_mesh(*mesh), distance);
  return solid.layers * (area(solid.shape) / distance / distance + needles(solid.shape, distance));
}

}  // namespace sessile
