#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sessile/output/snapshot.h"
#include "sessile/scene/read.h"
#include "sessile/scene/scene.h"

namespace sessile {

/// A frame of a run, on disk.
struct ResultFrame {
  std::int64_t number = 0;  ///< of its file's name
  double time = 0;          ///< [s]
  std::filesystem::path file;
};

/// What a run left behind: the folder that `sessile run` wrote, of a run that is done or still going on.
struct Results {
  std::filesystem::path folder;
  Scene scene;                      ///< as it ran, from scene.json, or from summary.json of an older run
  std::vector<ResultFrame> frames;  ///< by number; the first format that is there: vtp, ply
};

/// Looks into a folder of results. Throws FileError when it is none, holds no frames or no scene.
Results open_results(const std::filesystem::path& folder);

/// The scene of a folder with overrides put over it, and what its file says of it.
/// Throws SceneError as read_resolved_scene(), FileError when there is none.
ResolvedScene read_resolved_result(const std::filesystem::path& folder, std::span<const std::string> overrides = {});

/// The scene alone, of a folder that may hold no frames. Throws FileError when there is none.
Scene read_result_scene(const std::filesystem::path& folder);

/// Reads a frame that this program wrote, .vtp or .ply, with all its columns.
/// Throws FileError with the path and what is wrong: not there, cut short, not ours.
Snapshot read_frame(const std::filesystem::path& file);

/// The frame at or next to a time [s]; of two that are equally near, the earlier.
const ResultFrame& frame_at(const Results& results, double time);

}  // namespace sessile
