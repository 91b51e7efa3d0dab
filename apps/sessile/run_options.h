#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sessile/scene/read.h"

namespace sessile::app {

/// What every command that runs scenes can be told.
struct RunOptions {
  std::string scene;
  std::string folder;
  std::vector<std::string> overrides;  ///< `path=value`; --until adds its own
  MeshPlaces places = MeshPlaces::in_its_folder;
  std::optional<double> until;
  int threads = 0;
  std::string progress = "auto";
};

/// Adds --allow-outside.
void add_allow_outside(CLI::App& command, MeshPlaces& places);

/// Adds SCENE, --output, --set, --allow-outside, --until, --threads and --progress. `folder_help` says what -o is.
void add_run_options(CLI::App& command, RunOptions& options, const std::string& folder_help);

/// Takes over the threads and the end that were asked for, and the folder of a name when none was given.
void apply_run_options(RunOptions& options, const std::string& folder_suffix);

/// Says of a number that a user typed what the range check of a scene would say under another name; else "".
std::string finite_and_positive(const std::string& word);

/// The same of a number in another unit than seconds.
std::string finite_and_positive_in(std::string_view unit, const std::string& word);

}  // namespace sessile::app
