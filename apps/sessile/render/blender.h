#pragma once

#include <filesystem>

#include "job.h"
#include "progress.h"

namespace sessile::app {

/// How Blender is run.
struct BlenderOptions {
  int threads = 0;  ///< 0: as many as there are processors
  ProgressStyle progress = ProgressStyle::plain;
};

/// Has Blender do the job, and shows how far it is. What Blender prints goes to blender.log in the output folder.
/// False when Ctrl-C ended it. Throws Error when there is no Blender, no script, or when Blender failed.
bool run_blender(const RenderJob& job, const BlenderOptions& options);

}  // namespace sessile::app
