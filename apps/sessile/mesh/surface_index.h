#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sessile/core/vec.h"

namespace sessile::app {

/// A frame in surface.json.
struct SurfaceEntry {
  std::int64_t number = 0;
  double time = 0;                 ///< [s]
  std::vector<std::string> files;  ///< that hold it, the one for other programs to take first
  std::size_t triangles = 0;
};

/// surface.json: what lies in a folder of surfaces, and what it was made of.
struct SurfaceIndex {
  std::string source;    ///< the folder of the particles, as seen from that of the surfaces
  double spacing = 0;    ///< of the particles [m]
  Vec3d up{0, 0, 1};     ///< against gravity, of length 1
  std::string settings;  ///< of the surfaces, as JSON
  std::vector<SurfaceEntry> frames;
  std::vector<SurfaceEntry> waiting;  ///< frames that no whole file holds yet, but one that all frames go into

  struct Solid {
    std::string label;
    std::string file;
  };
  std::vector<Solid> solids;

  /// Whether surfaces of the two come from the same particles in the same way.
  bool same_origin(const SurfaceIndex& other) const;
};

/// The text of surface.json.
std::string index_json(const SurfaceIndex& index);

/// Reads surface.json; an empty index where there is none, or none that this program could have written.
SurfaceIndex read_index(const std::filesystem::path& file);

}  // namespace sessile::app
