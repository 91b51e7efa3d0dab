#include "start.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

#include "say.h"
#include "sessile/version.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

#ifdef SESSILE_VARIANTS
constexpr bool has_variants = true;
#else
constexpr bool has_variants = false;
#endif

fs::path folder_of(std::string_view isa) { return fs::path("lib") / "sessile" / isa; }

/// The program for an instruction set; the baseline is the one that users call.
fs::path program_for(std::string_view isa) {
  return installed_in() / (isa == isa_names.back() ? fs::path("bin") : folder_of(isa)) / "sessile";
}

/// Those to choose among. Only the baseline chooses, so that no program is ever started in turns with another.
std::vector<Isa> eligible_isas() {
  std::vector<Isa> isas = known_isas();
  const std::string own = build_info().isa;
  const bool chooses = has_variants && own == isa_names.back();
  for (Isa& isa : isas) isa.there = isa.name == own || (chooses && isa.there);
  return isas;
}

/// Whether the stack is large enough; says so where it is not. Steps keep their arrays elsewhere, and run with 128 KiB;
/// with 64 KiB the system ends the program without a word.
bool has_stack() {
  constexpr rlim_t least = rlim_t{256} << 10;
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= least) return true;
  say(stderr,
      fmt::format("sessile: the stack is limited to {} KiB, which is too little; `ulimit -s 8192` gives enough\n",
                  limit.rlim_cur >> 10));
  return false;
}

/// Asks for OpenMP threads that soon sleep when they wait, unless the user has chosen otherwise; true where that takes
/// a new start, since the runtime reads its environment before main. By default they spin for long: beside other work
/// on the same cores, a step then takes up to 60 times longer (docs/decisions/threads-wait-passively.md).
bool let_threads_sleep() {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return false;
  // Some microseconds of spinning bridge the gap between two loops of a step; GCC's runtime heeds the count.
  return setenv("OMP_WAIT_POLICY", "passive", 0) == 0 && setenv("GOMP_SPINCOUNT", "1000", 0) == 0;
}

}  // namespace

bool start(char** argv) {
  if (!has_stack()) return false;
  const bool anew = let_threads_sleep();
  const char* const wish = std::getenv("SESSILE_ISA");
  const std::string own = build_info().isa;
  std::vector<Isa> isas = eligible_isas();
  for (;;) {
    const IsaChoice choice = choose_isa(isas, wish == nullptr ? "" : wish);
    if (!choice.fault.empty()) {
      say(stderr, fmt::format("{}\n", choice.fault));
      return false;
    }
    if (choice.isa == own) {
      if (anew) execv("/proc/self/exe", argv);
      return true;  // where that does not work, the program runs all the same
    }
    execv(program_for(choice.isa).c_str(), argv);
    for (Isa& isa : isas) isa.there = isa.there && isa.name != choice.isa;  // what does not start is as good as absent
  }
}

std::vector<Isa> known_isas() {
  const std::string own = build_info().isa;
  std::vector<Isa> isas;
  for (const std::string_view name : isa_names) {
    const bool there = name == own || (has_variants && access(program_for(name).c_str(), X_OK) == 0);
    isas.push_back({std::string(name), there, processor_runs(name)});
  }
  const bool listed = std::any_of(isas.begin(), isas.end(), [&](const Isa& isa) { return isa.name == own; });
  if (!listed) isas.insert(isas.begin(), {own, true, processor_runs(own)});
  return isas;
}

fs::path installed_in() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path above = folder.parent_path().parent_path().parent_path();
  return folder == above / folder_of(build_info().isa) ? above : folder.parent_path();
}

}  // namespace sessile::app
