#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <memory>

#include "bench/context.h"
#include "commands.h"
#include "machine.h"
#include "say.h"
#include "sessile/output/file.h"
#include "sessile/scene/spelling.h"
#include "sessile/version.h"

namespace sessile::app {
namespace {

using namespace bench;

constexpr std::array cases{
    Case{"s1", "ms a step of S1", bench_s1},
    Case{"s1_fast", "2 s of S1 at the fastest sound settings", bench_s1_fast},
    Case{"s2_250k", "ms a step of 250 000 particles, by stage; memory", bench_s2_250k},
    Case{"s2_1m", "the same of 1 000 000", bench_s2_1m},
    Case{"neighbors", "sort and neighbour list of 1 000 000 points", bench_neighbors},
    Case{"passes", "ns a particle of each pass, and of what the machine allows", bench_passes},
    Case{"solver", "iterations of the pressure solver", bench_solver},
    Case{"scaling", "32 000 to 4 000 000 particles, one thread and all; the cost of the timers", bench_scaling},
};

struct BenchOptions {
  std::vector<std::string> names;
  int runs = 5;
  int threads = 0;
  std::size_t particles = 0;
  std::string json;
};

/// What is wrong with the name of a case; "" if nothing.
std::string wrong_case(const std::string& name) {
  std::vector<std::string_view> names;
  for (const Case& each : cases) names.push_back(each.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return {};
  return in_quotes(name) + " is no case" + fmt::format(" (cases: {})", fmt::join(names, ", "));
}

/// What is wrong with the place of the file to write, told before minutes of measuring; "" if nothing.
std::string wrong_place(const std::string& file) {
  std::filesystem::path folder = std::filesystem::path(file).parent_path();
  if (folder.empty()) folder = ".";
  if (std::filesystem::is_directory(file)) return in_quotes(file) + " is a folder";
  if (std::filesystem::is_directory(folder) && access(folder.c_str(), W_OK) == 0) return {};
  return "nothing can be written into " + in_quotes(folder.string());
}

bool wanted(const BenchOptions& options, std::string_view name) {
  return options.names.empty() || std::find(options.names.begin(), options.names.end(), name) != options.names.end();
}

void run_bench(const BenchOptions& options) {
  // Nothing is half written at any time: the program may end where it stands.
  std::signal(SIGINT, [](int) { _exit(128 + SIGINT); });
  if (options.threads > 0) omp_set_num_threads(options.threads);
  Report report(options.particles == 0);
  Context context{options.runs, omp_get_max_threads(), options.particles, report};
  const BuildInfo build = build_info();
  say(stdout, fmt::format("sessile {}, {}, {}, {}-bit numbers, {} lanes of {}\n{} threads on {}\n", build.version,
                          build.compiler, build.type, build.real_bits, build.lanes, build.simd, context.threads,
                          processor_name()));
  say(stdout, report.goals() ? "Goals are set for 2 cores with AVX-512 and nothing else on them.\n"
                             : "A trial at another size: goals do not apply.\n");
  measure_ceilings(context);
  for (const Case& each : cases) {
    if (wanted(options, each.name)) each.run(context);
  }
  if (!options.json.empty()) write_whole(options.json, report_json(report));
}

}  // namespace

void add_bench(CLI::App& program, int&) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = program.add_subcommand("bench", "Measure speed and memory, beside what the machine can do.");
  std::string names = "what to measure, as often as wanted (default: all):";
  for (const Case& each : cases) names += fmt::format("\n{}: {}", each.name, each.summary);
  command->add_option("--case", options->names, names)
      ->type_name("NAME")
      ->expected(1)
      ->check(wrong_case, "")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--runs", options->runs, "samples of each figure")
      ->type_name("N")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--threads", options->threads, "threads to use (default: all)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->add_option("--particles", options->particles, "try it with about so many particles instead")
      ->type_name("N")
      ->check(CLI::Range(1000, 10'000'000));
  command->add_option("--json", options->json, "write every sample to this file")
      ->type_name("FILE")
      ->check(wrong_place, "");
  command->callback([options] { run_bench(*options); });
}

}  // namespace sessile::app
