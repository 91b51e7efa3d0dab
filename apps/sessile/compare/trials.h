#pragma once

#include <filesystem>
#include <string>

#include "comparison.h"
#include "methods.h"
#include "progress.h"

namespace sessile::app {

/// What all runs of a comparison share.
struct TrialSettings {
  std::string scene_file;
  std::filesystem::path folder;  ///< of the comparison
  std::string progress;          ///< as --progress has it
  double search_until = 0;       ///< where trials of a step end [s]
  double search_max = 0;         ///< no step above is tried [s]
};

/// Runs a scene into a folder below the comparison's, or reads what it came to when that has been done before for the
/// very same scene; says which. `label` names the run for people. Throws FileError.
RunRecord run_or_reuse(const ResolvedScene& resolved, const TrialSettings& settings, const std::string& folder,
                       const std::string& label, bool stop_unsound);

/// Looks for the largest fixed step at which the method's run stays sound, and fills in the report. Ends early when a
/// signal asks for it; then `searched` stays false.
void search_largest_step(const Contestant& contestant, const TrialSettings& settings, MethodReport& report);

}  // namespace sessile::app
