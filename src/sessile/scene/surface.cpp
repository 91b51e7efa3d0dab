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

using std::numbers::pi;
constexpr double thinnest = 0.25;  // over the spacing: a further layer of less radius or height would fall together

/// What every sampler is told.
struct Request {
  double spacing;
  int layers;
  std::string who;
};

/// Steps along an edge, at least one, so that its two ends are always samples.
double edge_steps(double length, double spacing) { return std::max(1.0, steps_in(length, spacing)); }

/// Points along the edges of a lattice that fills a box from face to face; `grown` shells of it lie outside the box.
std::array<double, 3> box_points(const Vec3d& size, const Request& request, int grown) {
  return {edge_steps(size.x, request.spacing) + 1 + 2.0 * grown, edge_steps(size.y, request.spacing) + 1 + 2.0 * grown,
          edge_steps(size.z, request.spacing) + 1 + 2.0 * grown};
}

/// No difference of two products: where these are huge nothing would be left of it.
double count_shells(const std::array<double, 3>& points, int layers) {
  const double whole = points[0] * points[1] * points[2];
  const double shells = 2.0 * layers * (points[0] * points[1] + points[1] * points[2] + points[2] * points[0]);
  return std::min(whole, shells);
}

/// Samples of a shape, at most; within a few per cent of them where there are many.
double count(const Box& box, const Request& request) {
  return count_shells(box_points(box.size, request, 0), request.layers);
}

double count(const Container& container, const Request& request) {
  return count_shells(box_points(container.size, request, request.layers - 1), request.layers);
}

double count(const Plate& plate, const Request& request) {
  return (edge_steps(plate.width, request.spacing) + 1) * (edge_steps(plate.depth, request.spacing) + 1) *
         request.layers;
}

double count(const Sphere& sphere, const Request& request) {
  const double relative = sphere.radius / request.spacing;
  return (4 * pi * relative * relative + 1) * request.layers;
}

/// Rings of the side, and those of both ends; each has a sample at least, however thin the cylinder is.
double count(const Cylinder& cylinder, const Request& request) {
  const double levels = edge_steps(cylinder.height, request.spacing),
               circles = edge_steps(cylinder.radius, request.spacing);
  const double around = 2 * pi * cylinder.radius / request.spacing + 1;
  return (around * (levels + 1) + (around + 1) * circles) * request.layers;
}

double count(const Mesh& mesh, const Request& request) {
  return request.layers * estimate_mesh(load_mesh(mesh), request.spacing);
}

/// The outermost `layers` shells of a lattice that fills a box from face to face. `grown` shells lie outside the box.
std::vector<Vec3d> box_shells(const Vec3d& size, const Request& request, int grown) {
  const std::array<double, 3> points = box_points(size, request, grown);
  const Vec3d step{size.x / (points[0] - 1 - 2.0 * grown), size.y / (points[1] - 1 - 2.0 * grown),
                   size.z / (points[2] - 1 - 2.0 * grown)};
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

Request request_of(const Solid& solid, double spacing) {
  return {solid.spacing.value_or(spacing), solid.layers, called("solid", solid.label, name_of(solid.shape))};
}

}  // namespace

std::vector<Vec3d> sample_surface(const Solid& solid, double spacing) {
  const Request request = request_of(solid, spacing);
  auto samples = std::visit(
      [&]<Named T>(const T& shape) {
        // A mesh is counted by its own sampler, which has read it.
        if constexpr (!std::is_same_v<T, Mesh>) check_count(count(shape, request), request.who);
        return sample_shape(shape, request);
      },
      solid.shape);
  const Frame frame(solid.placement);
  for (auto& sample : samples) sample = frame.to_world(sample);
  return samples;
}

double estimate_surface(const Solid& solid, double spacing) {
  const Request request = request_of(solid, spacing);
  return std::visit([&](const auto& shape) { return count(shape, request); }, solid.shape);
}

}  // namespace sessile
