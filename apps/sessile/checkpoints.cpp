#include "checkpoints.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <string_view>
#include <system_error>
#include <utility>

#include "mesh/surface_folder.h"
#include "sessile/core/error.h"
#include "sessile/output/durable.h"
#include "sessile/output/file.h"
#include "sessile/scene/describe.h"
#include "sessile/version.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = "checkpoint_", suffix = ".sessile";

struct Kept {
  std::int64_t step;
  fs::path file;
};

/// The step that a file's name tells, if it is a checkpoint's.
std::optional<std::int64_t> step_of(std::string_view name) {
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return {};
  name = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
  std::int64_t step = 0;
  const auto [rest, error] = std::from_chars(name.data(), name.data() + name.size(), step);
  if (error != std::errc{} || rest != name.data() + name.size()) return {};
  return step;
}

/// By step, the newest first; none where there is no folder.
std::vector<Kept> list(const fs::path& folder) {
  std::vector<Kept> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    if (const auto step = step_of(entry.path().filename().string())) found.push_back({*step, entry.path()});
  }
  std::ranges::sort(found, std::greater{}, &Kept::step);
  return found;
}

void remove_file(const fs::path& file) {
  std::error_code error;
  if (!fs::remove(file, error) && error) {
    throw FileError(fmt::format("{}: cannot remove this checkpoint: {}", file.string(), error.message()));
  }
}

}  // namespace

Checkpoints::Checkpoints(const fs::path& results, const CheckpointOutput& asked, std::optional<double> last)
    : folder_(results / checkpoint_folder_name),
      keep_(static_cast<std::size_t>(asked.keep)),
      pause_(60 * asked.minutes) {
  // The start is no checkpoint: a scene is all it takes to begin again.
  if (asked.interval) schedule_.emplace(*asked.interval, last.value_or(0));
}

bool Checkpoints::due(const Simulation& simulation) const {
  if (!wanted()) return false;
  return Clock::now() - last_ >= pause_ || (schedule_ && schedule_->due(simulation.time()));
}

void Checkpoints::served(double time) {
  if (schedule_) schedule_->done(time);
}

void Checkpoints::write(const Scene& scene, SimulationState state, const std::string& session) {
  std::error_code error;
  fs::create_directory(folder_, error);  // not the folder above: that one is only missing when somebody took it away
  sync_folder(folder_.parent_path());  // a checkpoint must not outlast, in a power cut, the files that it goes on with
  const fs::path surfaces = folder_.parent_path() / surface_folder_name;
  if (fs::is_directory(surfaces)) sync_folder(surfaces);
  const BuildInfo build = build_info();
  const fs::path file = folder_ / fmt::format("{}{:09}{}", prefix, state.totals.steps, suffix);
  write_checkpoint(file, {build.version, build.isa, to_json(scene), session, std::move(state)});
  last_ = Clock::now();
  const std::vector<Kept> all = list(folder_);
  for (std::size_t k = keep_; k < all.size(); ++k) remove_file(all[k].file);
}

FoundCheckpoint find_checkpoint(const fs::path& results, std::optional<double> at) {
  FoundCheckpoint found;
  std::optional<double> earliest;
  for (const Kept& each : list(results / checkpoint_folder_name)) {
    try {
      found.checkpoint = read_checkpoint(each.file);
    } catch (const ForeignCheckpoint& e) {
      // It may be the best there is: another program goes on from it, and nothing is to be written over it.
      if (!at) throw;
      found.passed_over.emplace_back(e.what());
      continue;
    } catch (const FileError& e) {
      found.passed_over.emplace_back(e.what());
      continue;
    }
    const double time = found.checkpoint.state.time;
    earliest = time;
    // A hair of a step forgives the rounding of many added ones.
    if (at && time - 1e-6 * found.checkpoint.state.last_step.dt > *at) continue;
    found.file = each.file;
    return found;
  }
  std::string what = fmt::format("{}: there is no checkpoint to go on from", results.string());
  if (earliest) what += fmt::format(" at {:.9g} s; the earliest is of {:.9g} s", *at, *earliest);
  for (const std::string& each : found.passed_over) what += "\n" + each;
  throw FileError(what);
}

bool has_checkpoints(const fs::path& results) { return !list(results / checkpoint_folder_name).empty(); }

void remove_checkpoints(const fs::path& results, std::optional<std::int64_t> after_step) {
  const fs::path folder = results / checkpoint_folder_name;
  for (const Kept& each : list(folder)) {
    if (!after_step || each.step > *after_step) remove_file(each.file);
  }
  std::error_code ignored;
  std::vector<fs::path> halves;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(fmt::format(".{}", prefix)) && name.ends_with(".part")) halves.push_back(entry.path());
  }
  for (const fs::path& half : halves) remove_file(half);
  if (fs::is_empty(folder, ignored)) fs::remove(folder, ignored);
}

}  // namespace sessile::app
