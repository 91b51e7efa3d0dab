#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sessile::app {

/// A frame's surface, as `sessile mesh` listed it.
struct SurfaceFile {
  std::int64_t number = 0;
  double time = 0;  ///< [s]
  std::filesystem::path file;
};

/// What surface.json lists.
struct Surfaces {
  std::filesystem::path list;       ///< surface.json itself
  std::vector<SurfaceFile> frames;  ///< by time
  std::vector<std::string> solids;  ///< their labels
};

/// Reads surface/surface.json in a folder of results. Throws FileError: not there, or not what `sessile mesh` writes.
Surfaces read_surfaces(const std::filesystem::path& results);

/// Frames per second at which a film of all frames runs as fast as the liquid did; 25 where no film could.
double true_rate(const Surfaces& surfaces);

}  // namespace sessile::app
