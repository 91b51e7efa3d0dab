#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sessile/scene/method.h"

namespace sessile::app {

/// A scene as one method computes it.
struct Contestant {
  std::string name;  ///< of the method; also of the folder of its results
  std::filesystem::path file;
  std::string title;
  ResolvedScene resolved;
};

/// Folders named `methods` where a method given by name is looked for, in this order: beside the scene, in the folders
/// above it, in the program's data.
std::vector<std::filesystem::path> method_folders(const std::filesystem::path& scene_file);

/// Finds and reads the methods of a list such as `none,paper,mine/new.json`, and puts the scene under each. Throws
/// SceneError with every fault of names, files and of what they make together with the scene.
std::vector<Contestant> read_contestants(const std::string& list, const std::filesystem::path& scene_file,
                                         const ResolvedScene& scene);

/// Throws SceneError when an override changes what methods decide.
void refuse_overrides_of_methods(const std::vector<std::string>& overrides);

}  // namespace sessile::app
