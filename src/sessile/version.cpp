#include "sessile/version.h"

#include "sessile/core/lanes.h"

namespace sessile {

std::string_view version() { return SESSILE_VERSION; }

BuildInfo build_info() {
  BuildInfo info;
  info.version = SESSILE_VERSION;
#if defined(__clang__)
  info.compiler = "Clang " __clang_version__;
#else
  info.compiler = "GCC " __VERSION__;
#endif
#ifdef NDEBUG
  info.type = "optimised";
#else
  info.type = "debug";
#endif
  info.isa = SESSILE_ISA;
  info.simd = xsimd::default_arch::name();
  info.lanes = lane_count;
  info.real_bits = 8 * static_cast<int>(sizeof(Real));
  return info;
}

}  // namespace sessile
