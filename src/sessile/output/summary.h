#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "sessile/measure/health.h"
#include "sessile/simulation.h"

namespace sessile {

/// How a run ended; stopped: by the program, before its end, for a reason of its own.
enum class RunStatus { done, interrupted, failed, stopped };

/// "done", "interrupted", "failed", "stopped".
std::string_view word(RunStatus status);

/// How often a run went unstable.
struct StabilityFacts {
  std::int64_t went_back = 0;     ///< to an earlier state
  std::int64_t undone_steps = 0;  ///< that this took back
  std::string last_fault;         ///< why it last did, as a sentence
  std::optional<RunFault> fault;  ///< that ended the run
};

/// A fault as a JSON object, with what can be done about it.
std::string fault_json(const RunFault& fault, const std::string& advice);

/// What only the program that runs a simulation knows.
struct RunFacts {
  RunStatus status = RunStatus::done;
  std::string message;       ///< what went wrong, when it failed; why it was stopped
  std::string version;       ///< of the program
  std::string scene_json;    ///< the resolved scene as JSON text
  double wall_time = 0;      ///< of the whole run [s]
  double output_time = 0;    ///< that the simulation waited for snapshots, frames and stats [s]
  double measures_time = 0;  ///< spent in measure() [s]
  double writer_time = 0;    ///< that the writer's own thread worked meanwhile [s]
  std::int64_t frames = 0;   ///< written whole
  StabilityFacts stability{};
};

/// What the simulation knows at the end of a run.
struct SimulationFacts {
  std::int64_t particles = 0;       ///< at the end
  std::int64_t wall_particles = 0;  ///< samples of all solids
  double time = 0;                  ///< simulated [s]
  Totals totals{};
  StageTimes stages{};
  std::size_t bytes = 0;  ///< own arrays
};

SimulationFacts simulation_facts(const Simulation& simulation);

/// Greatest memory the process has held so far [bytes]; 0 where the system does not tell.
std::size_t peak_memory();

/// Text of summary.json. A scene that is no valid JSON is kept as text.
std::string summary_json(const RunFacts& run, const SimulationFacts& simulation);

/// Writes summary.json whole or not at all. Throws FileError.
void write_summary(const std::filesystem::path& path, const RunFacts& run, const SimulationFacts& simulation);

}  // namespace sessile
