#pragma once

#include <string>
#include <vector>

#include "sessile/scene/read.h"
#include "sessile/scene/scene.h"
#include "sessile/scene/surface_settings.h"

namespace sessile {

/// One parameter of a scene as it will run.
struct ResolvedParameter {
  std::string path;    ///< e.g. "forces[0].cohesion"
  std::string value;   ///< as JSON; what an absent one stands for, in words
  std::string unit;    ///< SI; "" for a pure number, a word or a text
  bool given = false;  ///< by the file or an override; else the default
};

/// Every parameter of the scene, in the order of its declaration.
std::vector<ResolvedParameter> parameters(const ResolvedScene& resolved);

/// The parameters as a table for people: path, value, unit, given or default.
std::string describe(const ResolvedScene& resolved);

/// The scene as JSON that read_scene() reads back to the same scene; every parameter stands in it.
std::string to_json(const Scene& scene);

/// The same of the settings of a surface.
std::string to_json(const SurfaceSettings& settings);

/// Render settings as JSON, every parameter but those left open.
std::string to_json(const RenderSettings& settings);

}  // namespace sessile
