#include <cstddef>
#include <cstdint>

#include "fuzz/targets.h"

/// libFuzzer calls it with bytes of its own making. SESSILE_FUZZ_TARGET, from the build, is the target's name.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const auto& target : sessile::fuzz::targets) {
    if (target.name == SESSILE_FUZZ_TARGET) {
      sessile::fuzz::survive(target.read, {reinterpret_cast<const char*>(data), size});
    }
  }
  return 0;
}
