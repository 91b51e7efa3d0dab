#include <fmt/format.h>
#include <omp.h>

#include "commands.h"
#include "sessile/version.h"

namespace sessile::app {

void add_info(CLI::App& program, int&) {
  CLI::App* command = program.add_subcommand("info", "Print version, build, instruction set and threads.");
  command->callback([] {
    const BuildInfo build = build_info();
    fmt::print("version    {}\n", build.version);
    fmt::print("compiler   {}\n", build.compiler);
    fmt::print("build      {}, {}-bit numbers\n", build.type, build.real_bits);
    fmt::print("SIMD       {}, {} lanes\n", build.simd, build.lanes);
    fmt::print("threads    {}\n", omp_get_max_threads());
  });
}

}  // namespace sessile::app
