#include "bench/scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sessile/scene/read.h"

namespace sessile::app::bench {
namespace {

/// Particles of a scene, from the size of its bodies, which are all boxes.
double count(const Scene& scene) {
  double volume = 0;
  for (const Body& body : scene.bodies) {
    const Vec3d size = std::get<Box>(body.shape).size;
    volume += size.x * size.y * size.z;
  }
  return volume / std::pow(scene.spacing, 3);
}

}  // namespace

Scene bench_scene(std::string_view name, std::size_t particles) {
  const std::string text(scene_texts().at(name)), file = fmt::format("bench/{}.json", name);
  Scene scene = read_resolved_text(text, file).scene;
  if (particles == 0) return scene;
  const double spacing = scene.spacing * std::cbrt(count(scene) / static_cast<double>(particles));
  const std::vector<std::string> overrides{fmt::format("spacing={:.17g}", spacing)};
  return read_resolved_text(text, file, overrides).scene;
}

Scene block_scene(int edge, int iterations) {
  Scene scene;
  scene.spacing = 0.1;
  scene.time.end = 1;
  scene.time.fixed_dt = 1e-3;
  scene.fluid.viscosity = 10;
  scene.forces = {SurfaceFeature{}};
  Iisph solver;
  solver.min_iterations = solver.max_iterations = iterations;
  scene.pressure = solver;
  Body body;
  const double size = edge * scene.spacing;
  body.shape = Box{{size, size, size}};
  body.jitter = 0.1;
  scene.bodies = {body};
  return scene;
}

int edge_of(std::size_t particles) {
  return std::max(2, static_cast<int>(std::lround(std::cbrt(static_cast<double>(particles)))));
}

}  // namespace sessile::app::bench
