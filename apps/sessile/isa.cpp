#include "isa.h"

#include <fmt/format.h>

#include <algorithm>

#include "sessile/scene/spelling.h"

#ifdef __x86_64__
#include <cpuid.h>
#endif

namespace sessile::app {
namespace {

#ifdef __x86_64__
bool has_bits(unsigned leaf, unsigned ecx_bits) {
  unsigned eax = 0;
  unsigned ebx = 0;
  unsigned ecx = 0;
  unsigned edx = 0;
  return __get_cpuid(leaf, &eax, &ebx, &ecx, &edx) != 0 && (ecx & ecx_bits) == ecx_bits;
}

// GCC 12 knows the levels by name, Clang 14 does not; it does not know F16C, LZCNT and MOVBE either. What the compilers
// tell includes that the operating system keeps the wide registers.
bool runs_v3() {
  return __builtin_cpu_supports("avx") != 0 && __builtin_cpu_supports("avx2") != 0 &&
         __builtin_cpu_supports("fma") != 0 && __builtin_cpu_supports("bmi") != 0 &&
         __builtin_cpu_supports("bmi2") != 0 && has_bits(1, bit_F16C | bit_MOVBE) && has_bits(0x80000001, bit_LZCNT);
}

bool runs_v4() {
  return runs_v3() && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
         __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
         __builtin_cpu_supports("avx512vl") != 0;
}
#else
bool runs_v3() { return false; }
bool runs_v4() { return false; }
#endif

std::string list_names(const std::vector<Isa>& isas, bool all) {
  std::vector<std::string> names;
  for (const Isa& isa : isas) {
    if (isa.there && (all || isa.runs)) names.push_back(isa.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

bool processor_runs(std::string_view isa) {
  if (isa == "x86-64-v4") return runs_v4();
  if (isa == "x86-64-v3") return runs_v3();
  return true;
}

IsaChoice choose_isa(const std::vector<Isa>& isas, std::string_view wish) {
  const auto chosen = std::find_if(isas.begin(), isas.end(), [&](const Isa& isa) {
    return wish.empty() ? isa.there && isa.runs : isa.name == wish;
  });
  const bool found = chosen != isas.end();
  if (found && chosen->there && chosen->runs) return {chosen->name, {}};
  const std::string fit = list_names(isas, false);
  if (wish.empty() || fit.empty()) {
    return {{},
            "this processor does not have the instruction set that sessile is built for: " + list_names(isas, true)};
  }
  const std::string why = !found           ? fmt::format("unknown instruction set {}", in_quotes(wish))
                          : !chosen->there ? fmt::format("{} is not installed", wish)
                                           : fmt::format("this processor does not run {}", wish);
  return {{}, fmt::format("SESSILE_ISA: {} (valid instruction sets: {})", why, fit)};
}

}  // namespace sessile::app
