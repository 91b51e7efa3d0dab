#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sessile/scene/render_settings.h"

namespace sessile::app {

/// The render settings of the scene that ran, with overrides such as `camera.elevation=40` put over them. Throws
/// SceneError with every fault of the overrides, FileError when the folder holds no scene.
RenderSettings read_render_settings(const std::filesystem::path& results, std::vector<std::string> overrides);

/// Throws SceneError when the settings speak of solids that are not there.
void check_solids(const RenderSettings& settings, const std::vector<std::string>& labels);

}  // namespace sessile::app
