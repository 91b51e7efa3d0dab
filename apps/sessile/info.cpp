#include <fmt/format.h>
#include <omp.h>

#include <string>
#include <vector>

#include "commands.h"
#include "sessile/version.h"
#include "start.h"

namespace sessile::app {

namespace {

/// The instruction sets that the program is there for.
std::vector<std::string> variants() {
  std::vector<std::string> names;
  for (const Isa& isa : known_isas()) {
    if (isa.there) names.push_back(isa.name + (isa.runs ? "" : " (not on this processor)"));
  }
  return names;
}

}  // namespace

void add_info(CLI::App& program, int&) {
  CLI::App* command = program.add_subcommand("info", "Print version, build, instruction sets and threads.");
  command->callback([] {
    const BuildInfo build = build_info();
    fmt::print("version    {}\n", build.version);
    fmt::print("compiler   {}\n", build.compiler);
    fmt::print("build      {}, {}-bit numbers\n", build.type, build.real_bits);
    fmt::print("SIMD       {} ({}), {} lanes\n", build.isa, build.simd, build.lanes);
    fmt::print("variants   {}\n", fmt::join(variants(), ", "));
    fmt::print("threads    {}\n", omp_get_max_threads());
  });
}

}  // namespace sessile::app
