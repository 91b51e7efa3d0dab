#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sessile/scene/render_settings.h"
#include "surfaces.h"

namespace sessile::app {

/// What Blender is to do, in tools/blender/sessile/film.py's words.
struct RenderJob {
  std::filesystem::path surfaces;  ///< the folder of surface.json
  std::filesystem::path output;    ///< folder for the pictures
  std::filesystem::path blend;     ///< a file to save instead of rendering; empty to render
  std::vector<std::int64_t> frames;
  RenderSettings settings;
};

std::string job_json(const RenderJob& job);

/// `frame_000012.png` in the folder.
std::filesystem::path picture_of(const std::filesystem::path& folder, std::int64_t number);

/// Whether there is a picture of this surface and the surface has not been made anew since.
bool is_rendered(const std::filesystem::path& folder, const SurfaceFile& surface);

}  // namespace sessile::app
