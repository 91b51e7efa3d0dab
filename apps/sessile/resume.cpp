#include "resume.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "checkpoints.h"
#include "fault_dump.h"
#include "folder_lock.h"
#include "mesh/surface_recorder.h"
#include "sessile/core/error.h"
#include "sessile/output/check.h"
#include "sessile/scene/input_file.h"
#include "sessile/scene/json_text.h"
#include "sessile/scene/spelling.h"
#include "sessile/scene/tuning.h"
#include "sessile/version.h"

namespace sessile::app {
namespace {

/// What many added steps may have rounded off a time [s].
double rounding(const SimulationState& state) { return 1e-6 * state.last_step.dt; }

constexpr std::uintmax_t largest_summary = std::uintmax_t{16} << 20;  // bytes

/// Whether surfaces go into one file, which has the same fields from its start to its end.
bool has_sequence(const Scene& scene) {
  const auto& surface = scene.output.surface;
  return surface && std::ranges::find(surface->formats, "usda") != surface->formats.end();
}

/// Whether no more surfaces are to be made: files for them end, and nothing else changes.
bool ends_surfaces(const Scene& wanted) { return wanted.output.surface && wanted.output.surface->formats.empty(); }

/// Parameters that may change between two steps, but not within one folder of results.
bool shapes_the_files(std::string_view path, const Scene& wanted) {
  if (path.starts_with("output.surface.formats")) return !ends_surfaces(wanted);
  if (path.starts_with("output.fields")) return has_sequence(wanted);
  return path.starts_with("output.formats") || path.starts_with("output.surface");
}

/// A mesh is where it is: what it has to be is told by the state, which refuses other solids.
void take_places_of_meshes(Scene& before, const Scene& wanted) {
  const auto take = [](auto& all, const auto& others) {
    for (std::size_t k = 0; k < std::min(all.size(), others.size()); ++k) {
      auto* const mesh = std::get_if<Mesh>(&all[k].shape);
      const auto* const other = std::get_if<Mesh>(&others[k].shape);
      if (mesh != nullptr && other != nullptr) mesh->file = other->file;
    }
  };
  take(before.solids, wanted.solids);
  take(before.bodies, wanted.bodies);
}

void refuse_changes(const Scene& before, const Scene& wanted, const SimulationState& state) {
  std::vector<std::string> faults;
  for (const std::string& path : differing_parameters(before, wanted)) {
    if (shapes_the_files(path, wanted)) {
      faults.push_back(path + ": cannot change when a run is resumed, as its folder would hold files of two kinds");
    }
  }
  if (wanted.time.end < before.time.end && wanted.time.end < state.time - rounding(state)) {
    faults.push_back(
        fmt::format("time.end: the run is at {:.9g} s already, beyond {:g} s; --at goes on from an earlier checkpoint",
                    state.time, wanted.time.end));
  }
  if (!faults.empty()) throw SceneError(std::move(faults));
}

SessionState session_in(const FoundCheckpoint& found) {
  try {
    return session_of(found.checkpoint.session, found.checkpoint.state.totals.steps);
  } catch (const Error& e) {
    throw FileError(fmt::format("{}: this checkpoint {}: it is not one of a run", found.file.string(), e.what()));
  }
}

/// What is wrong with a state is wrong with its file.
Simulation restored(Scene scene, SimulationState state, const std::string& file) {
  try {
    return {std::move(scene), std::move(state)};
  } catch (const SceneError& e) {
    std::vector<std::string> faults;
    for (const std::string& message : e.messages) faults.push_back(fmt::format("{}: {}", file, message));
    throw SceneError(std::move(faults));
  }
}

}  // namespace

Resumable open_run(const ResumeOptions& options) {
  FoundCheckpoint found = find_checkpoint(options.folder, options.at);
  std::vector<std::string> notes = std::move(found.passed_over);
  Checkpoint& checkpoint = found.checkpoint;
  const std::string file = found.file.string(), isa = build_info().isa;
  if (checkpoint.isa != isa) {
    notes.push_back(
        fmt::format("the steps so far were for {}, this program's are for {}: they round differently, so that "
                    "the run will not be the same to the last bit (SESSILE_ISA={} makes it so)",
                    printable(checkpoint.isa), isa, printable(checkpoint.isa)));
  }
  if (checkpoint.version != version()) {
    notes.push_back(
        fmt::format("the run was started by version {}, and this is {}: the rest may differ from what that "
                    "would have made of it",
                    printable(checkpoint.version), version()));
  }
  // The liquid is in the state: meshes that it was poured from need not be there any more.
  constexpr auto places = MeshPlaces::unasked;
  Scene before = read_resolved_text(checkpoint.scene_json, file, {}, {}, places).scene;
  const Scene wanted = read_resolved_text(checkpoint.scene_json, file, options.overrides, check_output, places).scene;
  take_places_of_meshes(before, wanted);
  refuse_changes(before, wanted, checkpoint.state);
  const bool changed = !differing_parameters(before, wanted).empty();
  SessionState session = session_in(found);
  Simulation simulation = restored(std::move(before), std::move(checkpoint.state), file);
  simulation.retune(wanted);
  return {std::move(simulation), std::move(session), changed, std::move(notes)};
}

bool is_complete(const std::filesystem::path& results, const Simulation& run) {
  try {
    const std::string text = read_input(results / "summary.json", largest_summary);
    const auto parsed = parsed_json(text);
    if (!parsed || !parsed->isObject()) return false;
    const Json::Value& summary = *parsed;
    const double beyond = summary["simulated_time_s"].asDouble() - run.scene().time.end, dt = run.last_step().dt;
    return summary["status"] == std::string(word(RunStatus::done)) && beyond >= -1e-6 * dt && beyond < dt;
  } catch (const FileError&) {
    return false;
  } catch (const Json::Exception&) {
    return false;
  }
}

void require_results(const std::filesystem::path& results, const Resumable& run) {
  refuse_if_in_use(results / surface_folder_name);
  refuse_if_in_use(results / fault_folder_name);
  const auto stats = results / "stats.csv";
  std::error_code error;
  const auto size = std::filesystem::file_size(stats, error);
  std::string fault;
  if (error) fault = std::filesystem::exists(stats) ? "it is no file" : error.message();
  if (!error && size < run.before.stats_bytes) fault = "it is shorter than it was at the checkpoint";
  if (!fault.empty()) throw FileError(fmt::format("cannot go on with {}: {}", stats.string(), fault));
  require_surfaces(results, run.simulation.scene(), run.before.surface_times);
}

}  // namespace sessile::app
