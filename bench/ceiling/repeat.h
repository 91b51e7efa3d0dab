#pragma once

#include <omp.h>

#include <algorithm>
#include <chrono>

namespace sessile::ceiling {

/// Lets a result look used, so that what made it is not left out.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

/// Seconds that one call of the slowest thread's `round()` takes, all threads at it together. `prepare()` gives each
/// thread a round of its own, with its own memory. Doubles the rounds until they take `seconds`.
template <class Prepare>
double seconds_a_round(int threads, double seconds, const Prepare& prepare) {
  using Clock = std::chrono::steady_clock;
  double taken = 0;
  long rounds = 1;
  bool enough = false;
#pragma omp parallel num_threads(threads)
  {
    auto round = prepare();
    round();
    while (true) {
#pragma omp barrier
      const auto start = Clock::now();
      for (long k = 0; k < rounds; ++k) round();
#pragma omp barrier
#pragma omp master
      {
        taken = std::chrono::duration<double>(Clock::now() - start).count();
        enough = taken >= seconds;
        if (!enough) rounds *= std::max(2L, taken > 0 ? static_cast<long>(std::min(64.0, 1.2 * seconds / taken)) : 2L);
      }
#pragma omp barrier
      if (enough) break;
    }
  }
  return taken / static_cast<double>(rounds);
}

}  // namespace sessile::ceiling
