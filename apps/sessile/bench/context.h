#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bench/report.h"
#include "sessile/measure/passes.h"

namespace sessile::app::bench {

/// What this machine can do with all the threads of the run together.
struct Ceilings {
  struct Bandwidth {
    double bytes = 0;         ///< in a set of so many bytes
    double bytes_per_ns = 0;  ///< read in order
  };
  std::vector<Bandwidth> read;  ///< by size, ascending
  double gathers = 0;           ///< numbers per ns
  double operations = 0;        ///< lane operations per ns

  /// The least time that a pass over n particles with so many neighbours each can take [ns of a core per particle].
  Bound bound(const PassWork& work, double n, double neighbors, int threads) const;
};

/// What a case is told, and where its figures go.
struct Context {
  int runs = 5;
  int threads = 1;
  std::size_t particles = 0;  ///< instead of each case's own size, where above 0
  Report& report;
  Ceilings ceilings{};
  std::optional<double> s1_iterations{};  ///< a step, once S1 has run
};

/// Something that `sessile bench` can measure.
struct Case {
  std::string_view name;
  std::string_view summary;
  void (*run)(Context&);
};

void measure_ceilings(Context& context);

void bench_s1(Context& context);
void bench_s1_fast(Context& context);
void bench_s2_250k(Context& context);
void bench_s2_1m(Context& context);
void bench_neighbors(Context& context);
void bench_passes(Context& context);
void bench_solver(Context& context);
void bench_scaling(Context& context);

/// Seconds that a call takes.
template <class F>
double seconds(F&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace sessile::app::bench
