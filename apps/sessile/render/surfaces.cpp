#include "surfaces.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>

#include "sessile/core/error.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

Json::Value read_list(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  Json::Value list;
  std::string errors;
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);
  if (!stream || !Json::parseFromStream(builder, stream, &list, &errors) || !list.isObject()) {
    throw FileError(fmt::format("cannot read {}: it is not what `sessile mesh` writes", file.string()));
  }
  return list;
}

/// A frame's PLY file, which is what Blender reads here; nothing when it was written in other formats only.
std::string ply_of(const Json::Value& frame) {
  for (const Json::Value& file : frame["files"]) {
    if (file.isString() && file.asString().ends_with(".ply")) return file.asString();
  }
  const Json::Value& file = frame["file"];
  return file.isString() && file.asString().ends_with(".ply") ? file.asString() : "";
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
  const Json::Value list = read_list(surfaces.list);
  for (const Json::Value& frame : list["frames"]) {
    const std::string file = ply_of(frame);
    if (file.empty() || !frame["number"].isInt64() || !frame["time"].isNumeric()) {
      throw FileError(fmt::format("{} lists a frame without a PLY file; run `sessile mesh {}` once more",
                                  surfaces.list.string(), results.string()));
    }
    surfaces.frames.push_back(
        {frame["number"].asInt64(), frame["time"].asDouble(), surfaces.list.parent_path() / file});
  }
  for (const Json::Value& solid : list["solids"]) surfaces.solids.push_back(solid["label"].asString());
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
