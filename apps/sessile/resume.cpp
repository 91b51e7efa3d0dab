#include "resume.h"

#include <fmt/format.h>
#include <json/json.h>

#include <memory>
#include <string_view>
#include <utility>

#include "checkpoints.h"
#include "sessile/core/error.h"
#include "sessile/output/check.h"
#include "sessile/scene/input_file.h"
#include "sessile/scene/tuning.h"
#include "sessile/version.h"

namespace sessile::app {
namespace {

constexpr std::uintmax_t largest_summary = std::uintmax_t{16} << 20;  // bytes

/// Parameters that may change between two steps, but not within one folder of results.
bool shapes_the_files(std::string_view path) {
  return path.starts_with("output.formats") || path.starts_with("output.surface");
}

void refuse_other_files(const Scene& before, const Scene& wanted) {
  std::vector<std::string> faults;
  for (const std::string& path : differing_parameters(before, wanted)) {
    if (shapes_the_files(path)) {
      faults.push_back(path + ": cannot change when a run is resumed, as its folder would hold files of two kinds");
    }
  }
  if (!faults.empty()) throw SceneError(std::move(faults));
}

SessionState session_in(const FoundCheckpoint& found) {
  try {
    return session_of(found.checkpoint.session);
  } catch (const Error& e) {
    throw FileError(fmt::format("{}: this checkpoint {}: it is not one of a run", found.file.string(), e.what()));
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
                    checkpoint.isa, isa, checkpoint.isa));
  }
  if (checkpoint.version != version()) {
    notes.push_back(
        fmt::format("the run was started by version {}, and this is {}: the rest may differ from what that "
                    "would have made of it",
                    checkpoint.version, version()));
  }
  const Scene before = read_resolved_text(checkpoint.scene_json, file).scene;
  const Scene wanted = read_resolved_text(checkpoint.scene_json, file, options.overrides, check_output).scene;
  refuse_other_files(before, wanted);
  SessionState session = session_in(found);
  Simulation simulation(before, std::move(checkpoint.state));
  simulation.retune(wanted);
  return {std::move(simulation), std::move(session), std::move(notes)};
}

bool is_complete(const std::filesystem::path& results, double end) {
  try {
    const std::string text = read_input(results / "summary.json", largest_summary);
    const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
    Json::Value summary;
    return reader->parse(text.data(), text.data() + text.size(), &summary, nullptr) && summary.isObject() &&
           summary["status"] == std::string(word(RunStatus::done)) && summary["simulated_time_s"].asDouble() >= end;
  } catch (const FileError&) {
    return false;
  } catch (const Json::Exception&) {
    return false;
  }
}

void drop_newer_checkpoints(const ResumeOptions& options, const Resumable& run) {
  remove_checkpoints(options.folder, run.simulation.totals().steps);
}

}  // namespace sessile::app
