#include "surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/surface_index.h"
#include "sessile/core/error.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

/// A frame's PLY file, which is what Blender reads here; nothing when it was written in other formats only.
std::string ply_of(const SurfaceEntry& frame) {
  const auto found = std::ranges::find_if(frame.files, [](const std::string& file) { return file.ends_with(".ply"); });
  return found == frame.files.end() ? "" : *found;
}

}  // namespace

Surfaces read_surfaces(const fs::path& results) {
  Surfaces surfaces;
  surfaces.list = results / "surface" / "surface.json";
  std::error_code error;
  if (!fs::is_directory(results, error)) throw FileError(fmt::format("there is no folder {}", results.string()));
  if (!fs::exists(surfaces.list, error)) {
    throw FileError(
        fmt::format("{} holds no surfaces; run `sessile mesh {}` first", results.string(), results.string()));
  }
  const SurfaceIndex index = read_index(surfaces.list);
  if (index.source.empty()) {
    throw FileError(fmt::format("cannot read {}: it is not what `sessile mesh` writes", surfaces.list.string()));
  }
  for (const SurfaceEntry& frame : index.frames) {
    const std::string file = ply_of(frame);
    if (file.empty()) {
      throw FileError(fmt::format("{} lists a frame without a PLY file; run `sessile mesh {}` once more",
                                  surfaces.list.string(), results.string()));
    }
    surfaces.frames.push_back({frame.number, frame.time, surfaces.list.parent_path() / file});
  }
  for (const SurfaceIndex::Solid& solid : index.solids) surfaces.solids.push_back(solid.label);
  std::ranges::sort(surfaces.frames, {}, &SurfaceFile::time);
  if (surfaces.frames.empty()) throw FileError(fmt::format("{} lists no frames", surfaces.list.string()));
  return surfaces;
}

double true_rate(const Surfaces& surfaces) {
  constexpr double slowest = 10, fastest = 60, usual = 25;
  std::vector<double> steps;
  for (std::size_t i = 1; i < surfaces.frames.size(); ++i) {
    steps.push_back(surfaces.frames[i].time - surfaces.frames[i - 1].time);
  }
  if (steps.empty()) return usual;
  std::ranges::sort(steps);
  const double rate = 1 / steps[steps.size() / 2];
  if (!(rate >= slowest && rate <= fastest)) return usual;
  // Frames fall on steps, so their distance is the asked one but for a hundredth or so.
  const double whole = std::round(rate);
  return std::abs(rate - whole) < 0.05 * whole ? whole : rate;
}

}  // namespace sessile::app
