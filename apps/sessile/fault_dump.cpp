#include "fault_dump.h"

#include <fmt/format.h>

#include <cmath>
#include <system_error>
#include <variant>
#include <vector>

#include "checkpoints.h"
#include "result_folder.h"
#include "sessile/core/error.h"
#include "sessile/measure/diagnostics.h"
#include "sessile/output/file.h"
#include "sessile/output/json_object.h"
#include "sessile/output/stats.h"
#include "sessile/output/summary.h"
#include "sessile/output/writer.h"
#include "sessile/scene/describe.h"
#include "session_state.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string>& columns() {
  static const std::vector<std::string> names{"id", "velocity", "density", "pressure"};
  return names;
}

/// The scene, so that a run that goes on in the folder of the dump writes what is there already.
Scene scene_of_dump(Scene scene) {
  scene.output.formats = {"vtp"};
  scene.output.columns = columns();
  scene.output.surface.reset();
  return scene;
}

void make_finite(std::vector<float>& values) {
  for (float& value : values) {
    if (!std::isfinite(value)) value = 0;
  }
}

}  // namespace

Snapshot faulty_frame(const Simulation& simulation, const RunFault& fault) {
  Snapshot frame = take_snapshot(simulation, columns());
  frame.time = fault.time;
  frame.step = fault.step;
  make_finite(frame.points);
  for (Column& column : frame.columns) {
    if (auto* values = std::get_if<std::vector<float>>(&column.values)) make_finite(*values);
  }
  return frame;
}

namespace {

void refuse_other_results(const fs::path& folder) {
  for (const char* const name : {"scene.json", "stats.csv"}) {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(folder / name, error))) continue;
    throw FileError(fmt::format("{} holds results of another run, which are left alone", folder.string()));
  }
}

void write_parts(const fs::path& folder, const Simulation& good, const Snapshot& faulty, const RunFault& fault,
                 const std::string& advice) {
  // First what tells it from other results: a run that was killed meanwhile leaves what the next one takes away.
  write_whole(folder / fault_file_name, fault_json(fault, advice) + "\n");
  const Scene scene = scene_of_dump(good.scene());
  write_whole(folder / "scene.json", to_json(scene));
  FrameWriter frames(folder, scene.output.formats);
  frames.write_solids(take_solids(good.walls()));
  frames.push(take_snapshot(good, columns()));
  SessionState session;
  session.frame_times = frames.settle();
  session.frame_due = good.time();
  frames.push(faulty);
  frames.close();
  StatsWriter stats(folder / "stats.csv", good.walls().labels);
  stats.write(good, measure(good));
  session.stats_bytes = stats.settle();
  session.stats_time = good.time();
  CheckpointOutput one;
  one.keep = 1;
  Checkpoints(folder, one, {}).write(scene, good.state(), session_json(session));
}

}  // namespace

void write_fault_dump(const fs::path& folder, const Simulation& good, const Snapshot& faulty, const RunFault& fault,
                      const std::string& advice) {
  remove_fault_dump(folder);
  refuse_other_results(folder);
  create_output_folder(folder);
  try {
    write_parts(folder, good, faulty, fault, advice);
  } catch (...) {
    // A half one can neither be opened nor gone on from, and takes room on a disk that is full.
    try {
      remove_fault_dump(folder);
    } catch (const std::exception&) {
      // The first error is the one to report.
    }
    std::error_code not_empty;
    fs::remove(folder, not_empty);
    throw;
  }
}

void remove_fault_dump(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return;              // a link is not ours to follow
  if (!fs::exists(fs::symlink_status(folder / fault_file_name, error))) return;  // somebody's results, no dump
  fresh_folder(folder);
  if (!fs::remove(folder / "stats.csv", error) && error) {
    throw FileError(fmt::format("{}: cannot remove this result of an earlier run: {}", (folder / "stats.csv").string(),
                                error.message()));
  }
  if (fs::is_empty(folder, error)) fs::remove(folder, error);
}

}  // namespace sessile::app
