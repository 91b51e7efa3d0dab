#include <array>

#include "ceiling/ceiling.h"
#include "ceiling/repeat.h"
#include "sessile/core/lanes.h"

namespace sessile::ceiling {

double multiply_add_rate(int threads, double seconds) {
  constexpr int turns = 4096;
  constexpr std::size_t chains = 12;  // as many at once hide the latency of four cycles on two units, and fit registers
  const double round = seconds_a_round(threads, seconds, [] {
    return [start = Real(1)]() mutable {
      keep(start);
      std::array<Lanes, chains> sums;
      sums.fill(Lanes(start));
      const Lanes a(Real(0.999)), b(Real(0.001));
      for (int turn = 0; turn < turns; ++turn) {
#pragma GCC unroll 12
        for (std::size_t k = 0; k < chains; ++k) sums[k] = xsimd::fma(sums[k], a, b);
      }
      keep(sums);
    };
  });
  return 1.0 * turns * chains * lane_count * threads / (1e9 * round);
}

}  // namespace sessile::ceiling
