#include "sessile/output/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace sessile {
namespace {

constexpr auto formats = std::to_array<FrameFormat>({
    {"vtp", "VTK PolyData for ParaView, with a collection frames.pvd that carries the physical time", encode_vtp},
    {"ply", "binary PLY point cloud", encode_ply},
});

}  // namespace

std::span<const FrameFormat> frame_formats() { return formats; }

const FrameFormat* find_frame_format(std::string_view name) {
  const auto found = std::find_if(formats.begin(), formats.end(), [&](const FrameFormat& f) { return f.name == name; });
  return found == formats.end() ? nullptr : &*found;
}

std::string frame_file_name(std::int64_t number, std::string_view format) {
  return fmt::format("frame_{:06}.{}", number, format);
}

std::string solids_file_name(std::string_view format) { return fmt::format("solids.{}", format); }

std::string encode_collection(std::span<const double> times) {
  std::vector<TimedFile> files;
  for (const double time : times) {
    files.push_back({time, frame_file_name(static_cast<std::int64_t>(files.size()), "vtp")});
  }
  return encode_pvd(files);
}

}  // namespace sessile
