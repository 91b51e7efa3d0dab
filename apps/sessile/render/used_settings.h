#pragma once

#include <filesystem>

#include "sessile/scene/render_settings.h"

namespace sessile::app {

/// Keeps the settings that a folder's pictures are made with in settings.json. Throws SceneError where pictures are
/// there that were made with others, unless they are to be made again: a film must not change its look half way.
void keep_settings(const std::filesystem::path& folder, const RenderSettings& settings, bool again);

}  // namespace sessile::app
