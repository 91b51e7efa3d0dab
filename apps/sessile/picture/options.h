#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw/moment.h"
#include "sessile/scene/read.h"

namespace sessile::app {

/// What `sessile picture` can be told.
struct PictureOptions {
  std::string source;          ///< a scene, or a folder of results
  std::string picture, video;  ///< the file to write; one of them
  std::string frames;          ///< which, as selected() reads it
  std::vector<double> times;   ///< [s]
  std::string field;           ///< that colours; the default one when empty
  draw::Look look = draw::Look::particles;
  std::optional<std::pair<float, float>> range;
  std::pair<int, int> size{1280, 720};     ///< [pixels]
  std::pair<double, double> view{20, 30};  ///< azimuth and elevation [deg]
  double zoom = 1;
  bool orthographic = false, no_legend = false, no_solids = false;
  int fineness = 2;
  double frames_per_second = 25;
  std::vector<std::string> overrides;  ///< of a scene
  MeshPlaces places = MeshPlaces::in_its_folder;
  int threads = 0;
  std::string progress = "auto";
};

/// Adds them to a command, with what can be said against a value by itself.
void add_picture_options(CLI::App& command, PictureOptions& options);

/// What is wrong with options that do not go together, or "".
std::string clash(const PictureOptions& options);

}  // namespace sessile::app
