#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "sessile/scene/fault.h"
#include "sessile/scene/scene.h"
#include "sessile/scene/surface_settings.h"

namespace sessile {

/// A scene, and what its file said of it.
struct ResolvedScene {
  Scene scene;
  std::set<std::string> given;                ///< paths of the values that the file or an override gives
  std::map<std::string, std::string> places;  ///< by path: "tablet.json:12", or "--set time.end"

  /// The fault as a line for people, with the place of its parameter or of the nearest group around it:
  /// `tablet.json:12: forces[0].cohesion: must be at least 0, found -1`.
  std::string locate(const Fault& fault) const;
};

/// Where the meshes that a scene names may lie. One that an override names may lie anywhere. `unasked`: anywhere, and
/// nobody asks whether they are there, since not all of them will be read.
enum class MeshPlaces { in_its_folder, anywhere, unasked };

/// Judges what the parts of a scene make together, beside validate(); such as check_output().
using FurtherCheck = std::function<std::vector<Fault>(const Scene&)>;

/// Reads a scene file and puts overrides, `path=value` each, over it. A value is read as JSON, or else taken as a text;
/// paths of meshes are relative to the scene file, and do not lead out of its folder, by a link neither, unless
/// `places` lets them. Throws SceneError with every fault of the file, of the overrides and of the scene they make (see
/// validate.h).
ResolvedScene read_resolved_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {},
                                  const FurtherCheck& further = {}, MeshPlaces places = MeshPlaces::in_its_folder);

/// The same of a scene that is at hand as text; `name` stands for the file in messages. What a run has written down of
/// itself names its meshes by where they were found, so that these may lie anywhere.
ResolvedScene read_resolved_text(std::string text, const std::string& name, std::span<const std::string> overrides = {},
                                 const FurtherCheck& further = {}, MeshPlaces places = MeshPlaces::anywhere);

/// The settings of a surface with overrides put over them, as those of a scene: "cube_size=0.5", "method.type=density".
/// Throws SceneError with every fault.
SurfaceSettings with_overrides(const SurfaceSettings& settings, std::span<const std::string> overrides);

/// The scene alone.
Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});

}  // namespace sessile
