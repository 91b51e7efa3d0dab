#include "trials.h"

#include <fmt/format.h>
#include <json/json.h>
#include <omp.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "say.h"
#include "sessile/core/error.h"
#include "sessile/measure/step_search.h"
#include "sessile/output/file.h"
#include "sessile/scene/describe.h"
#include "sessile/version.h"

namespace sessile::app {
namespace {

/// How a run ended, in a few words.
std::string ending(const RunRecord& record, bool again) {
  std::string text = fmt::format("{}{}, {:.1f} s", record.status, again ? " already" : "", record.wall);
  if (record.status == "interrupted") return text;
  if (record.status == "failed") return text + ": " + record.message;
  return text +
         (record.sound ? ", sound" : fmt::format(", unsound at {:.4g} s: {}", record.verdict_time, record.reason));
}

void tell(const TrialSettings& settings, const std::string& label, const std::string& text) {
  if (settings.progress != "json") return say(stdout, label + ": " + text + "\n");
  Json::Value line;
  line["run"] = label;
  line["ended"] = text;
  Json::StreamWriterBuilder compact;
  compact["indentation"] = "";
  say(stdout, Json::writeString(compact, line) + "\n");
}

/// The largest sound step among the trials to the scene's end, or the next one to run to the end.
class Search {
 public:
  Search(const Contestant& contestant, const TrialSettings& settings, MethodReport& report)
      : contestant_(contestant), settings_(settings), report_(report) {}

  void run() {
    const TimeSettings& time = contestant_.resolved.scene.time;
    const double greatest = report_.run && report_.run->dt_greatest > 0 ? report_.run->dt_greatest : time.dt_max;
    // A method that is unsound at a thirtieth of its own steps is hardly so for their length.
    const int start = place_at_most(greatest), least = std::max(place_at_least(time.dt_min), start - 15);
    const StepSearch search{start, least, place_at_most(settings_.search_max)};
    const bool to_the_end = settings_.search_until >= time.end;
    std::vector<StepTrial> trials;
    while (const auto place = next_trial(search, trials)) {
      const TrialReport* trial = try_step(*place, to_the_end);
      if (trial == nullptr) return;
      trials.push_back({*place, trial->record.sound});
    }
    auto place = largest_sound(trials);
    if (place && !to_the_end) {
      // The largest step of the short trials once more to the end, and smaller ones while that is unsound.
      for (; *place >= search.least; --*place) {
        const TrialReport* trial = try_step(*place, true);
        if (trial == nullptr) return;
        if (trial->record.sound) break;
      }
    }
    report_.searched = true;
    for (const TrialReport& trial : report_.trials) {
      if (place && trial.whole && trial.record.sound && trial.dt == step_at(*place)) report_.largest = trial;
    }
  }

 private:
  /// Runs a step and reports it; nothing when a signal ended it.
  const TrialReport* try_step(int place, bool whole) {
    if (stop_asked()) return nullptr;
    TrialReport trial{step_at(place), whole, {}, {}};
    const bool short_ones = settings_.search_until < contestant_.resolved.scene.time.end;
    trial.folder = fmt::format("{}/dt_{}{}", contestant_.name, trial.dt, whole && short_ones ? "_full" : "");
    ResolvedScene resolved = contestant_.resolved;
    resolved.scene.time.fixed_dt = trial.dt;
    if (!whole) resolved.scene.time.end = settings_.search_until;
    resolved.scene.output.formats.clear();
    if (resolved.scene.output.surface) resolved.scene.output.surface->formats.clear();
    const std::string label =
        fmt::format("{}, dt {} s{}", contestant_.name, trial.dt, whole && short_ones ? " to the end" : "");
    trial.record = run_or_reuse(resolved, settings_, trial.folder, label, true);
    if (!trial.record.finished()) return nullptr;
    report_.trials.push_back(std::move(trial));
    return &report_.trials.back();
  }

  const Contestant& contestant_;
  const TrialSettings& settings_;
  MethodReport& report_;
};

}  // namespace

RunRecord run_or_reuse(const ResolvedScene& resolved, const TrialSettings& settings, const std::string& folder,
                       const std::string& label, bool stop_unsound) {
  const std::filesystem::path path = settings.folder / folder, verdict = path / "verdict.json";
  const auto before = read_verdict(verdict);
  if (before && before->finished() && before->version == version() && before->threads == omp_get_max_threads() &&
      before->scene == to_json(resolved.scene)) {
    tell(settings, label, ending(*before, true));
    return *before;
  }
  std::error_code error;
  std::filesystem::remove(verdict, error);
  if (error) throw FileError(verdict.string() + ": cannot remove this verdict of an earlier run: " + error.message());
  RunObserver observer(stop_unsound);
  const SessionResult result =
      run_session(resolved, {settings.scene_file, path, progress_style(settings.progress), label, false},
                  [&](const Simulation& simulation) { return observer.look(simulation); });
  if (result.error) {
    try {
      std::rethrow_exception(result.error);
    } catch (const RunError&) {  // a method that fails has its place in the report; what else fails is not its fault
    }
  }
  RunRecord record = observer.record(result, resolved);
  write_whole(verdict, verdict_json(record));
  tell(settings, label, ending(record, false));
  return record;
}

void search_largest_step(const Contestant& contestant, const TrialSettings& settings, MethodReport& report) {
  Search(contestant, settings, report).run();
}

}  // namespace sessile::app
