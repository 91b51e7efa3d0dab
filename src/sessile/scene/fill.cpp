#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <type_traits>
#include <variant>

#include "sessile/core/first_error.h"
#include "sessile/core/memory_limit.h"
#include "sessile/scene/frame.h"
#include "sessile/scene/lattice.h"
#include "sessile/scene/mesh_space.h"
#include "sessile/scene/sampling.h"
#include "sessile/scene/traits.h"

namespace sessile {

namespace {

/// The points of a cubic lattice around `centre` that `inside` takes; as many per axis as fit the size.
template <class Inside>
std::vector<Vec3d> lattice(const Vec3d& centre, const Vec3d& size, double spacing, const std::string& who,
                           Inside&& inside) {
  const std::array<double, 3> counts{steps_in(size.x, spacing), steps_in(size.y, spacing), steps_in(size.z, spacing)};
  if (std::min({counts[0], counts[1], counts[2]}) < 1) return {};  // thinner than half a particle, however long
  check_count(counts[0] * counts[1] * counts[2], who);
  const auto nx = static_cast<std::int64_t>(counts[0]), ny = static_cast<std::int64_t>(counts[1]),
             nz = static_cast<std::int64_t>(counts[2]);
  std::vector<Vec3d> points;
  std::vector<char> taken(static_cast<std::size_t>(nx * ny));
  FirstError error;
  const double most = memory_limit().bytes / estimated_bytes(1, 1);  // where the estimate fell short
  for (std::int64_t k = 0; k < nz; ++k) {
    if (static_cast<double>(points.size()) > most) {
      throw SceneError(
          fmt::format("{}: needs more than {:.3g} particles, which is more than there is memory for "
                      "(a larger spacing needs fewer)",
                      who, most));
    }
    const auto place = [&](std::int64_t i, std::int64_t j) {
      return centre +
             Vec3d{centred_place(i, nx, spacing), centred_place(j, ny, spacing), centred_place(k, nz, spacing)};
    };
#pragma omp parallel for schedule(static)
    for (std::int64_t j = 0; j < ny; ++j) {
      error.guard([&] {
        for (std::int64_t i = 0; i < nx; ++i) taken[static_cast<std::size_t>(j * nx + i)] = inside(place(i, j)) ? 1 : 0;
      });
    }
    error.rethrow();
    for (std::int64_t j = 0; j < ny; ++j) {
      for (std::int64_t i = 0; i < nx; ++i) {
        if (taken[static_cast<std::size_t>(j * nx + i)] != 0) points.push_back(place(i, j));
      }
    }
  }
  return points;
}

std::vector<Vec3d> fill_shape(const Box& box, double spacing, const std::string& who) {
  return lattice({}, box.size, spacing, who, [](const Vec3d&) { return true; });
}

std::vector<Vec3d> fill_shape(const Sphere& sphere, double spacing, const std::string& who) {
  const double edge = 2 * sphere.radius;
  return lattice({}, {edge, edge, edge}, spacing, who,
                 [&](const Vec3d& p) { return squared_length(p) <= sphere.radius * sphere.radius; });
}

std::vector<Vec3d> fill_shape(const Cylinder& cylinder, double spacing, const std::string& who) {
  const double edge = 2 * cylinder.radius;
  return lattice({}, {edge, edge, cylinder.height}, spacing, who,
                 [&](const Vec3d& p) { return p.x * p.x + p.y * p.y <= cylinder.radius * cylinder.radius; });
}

TriangleMesh closed_mesh(const Mesh& file) {
  TriangleMesh mesh = load_mesh(file);
  if (!mesh.closed()) {
    throw SceneError(
        fmt::format("{}: is not closed ({} edges have a triangle on one side only), so liquid cannot fill it",
                    file.file, mesh.open_edges));
  }
  return mesh;
}

std::vector<Vec3d> fill_shape(const Mesh& file, double spacing, const std::string& who) {
  const TriangleMesh mesh = closed_mesh(file);
  const MeshSpace space(mesh);
  const Vec3d low = mesh.lower(), high = mesh.upper();
  return lattice(0.5 * (low + high), high - low, spacing, who, [&](const Vec3d& p) { return space.contains(p); });
}

/// The same number in [-1, 1) for the same seed, particle and axis, whatever else is in the scene.
double noise(std::uint64_t seed, std::uint64_t particle, std::uint64_t axis) {
  std::uint64_t z = (seed + 1) * 0x9e3779b97f4a7c15U + 3 * particle + axis;
  for (int round = 0; round < 2; ++round) {  // splitmix64's finaliser
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    z ^= z >> 31U;
  }
  return static_cast<double>(z >> 11U) * 0x1p-52 - 1;
}

}  // namespace

std::vector<Vec3d> fill(const Body& body, double spacing) {
  const std::string who = called("body", body.label, name_of(body.shape));
  auto points = std::visit([&](const auto& shape) { return fill_shape(shape, spacing, who); }, body.shape);
  if (points.empty())
    throw SceneError(fmt::format("{}: is too small to hold a particle of spacing {} m", who, spacing));
  const Frame frame(body.placement);
  const auto seed = static_cast<std::uint64_t>(body.seed);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (body.jitter > 0) {
      points[i] += body.jitter * spacing * Vec3d{noise(seed, i, 0), noise(seed, i, 1), noise(seed, i, 2)};
    }
    points[i] = frame.to_world(points[i]);
  }
  return points;
}

std::vector<Vec3d> layer(const Emitter& emitter, double spacing) {
  const std::string who = called("emitter", emitter.label, name_of(emitter.shape));
  const auto flat = [&](double width, double depth, auto inside) {
    return lattice({}, {width, depth, spacing}, spacing, who, inside);
  };
  auto points = std::visit(
      [&]<Named T>(const T& shape) {
        if constexpr (std::is_same_v<T, Disc>) {
          const double square = shape.radius * shape.radius;
          return flat(2 * shape.radius, 2 * shape.radius,
                      [=](const Vec3d& p) { return p.x * p.x + p.y * p.y <= square; });
        } else {
          return flat(shape.width, shape.depth, [](const Vec3d&) { return true; });
        }
      },
      emitter.shape);
  if (points.empty()) throw SceneError(fmt::format("{}: is too small for a particle of spacing {} m", who, spacing));
  const Frame frame(emitter.placement);
  for (auto& point : points) point = frame.to_world(point);
  return points;
}

double estimate_fill(const Body& body, double spacing) {
  constexpr double pi = std::numbers::pi;
  const double volume = std::visit(
      []<Named T>(const T& shape) {
        if constexpr (std::is_same_v<T, Box>) {
          return shape.size.x * shape.size.y * shape.size.z;
        } else if constexpr (std::is_same_v<T, Sphere>) {
          return 4 * pi / 3 * shape.radius * shape.radius * shape.radius;
        } else if constexpr (std::is_same_v<T, Cylinder>) {
          return pi * shape.radius * shape.radius * shape.height;
        } else {
          const TriangleMesh mesh = closed_mesh(shape);
          const double summed = std::abs(mesh.volume()), rough = MeshSpace(mesh).rough_volume();
          return rough > 1.2 * summed ? rough : summed;
        }
      },
      body.shape);
  return volume / spacing / spacing / spacing;
}

double estimate_layer(const Emitter& emitter, double spacing) {
  const double area = std::visit(
      []<Named T>(const T& shape) {
        if constexpr (std::is_same_v<T, Disc>) {
          return std::numbers::pi * shape.radius * shape.radius;
        } else {
          return shape.width * shape.depth;
        }
      },
      emitter.shape);
  return area / spacing / spacing;
}

}  // namespace sessile
