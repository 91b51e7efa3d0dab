#include <array>

#include "ceiling/ceiling.h"
#include "ceiling/repeat.h"
#include "sessile/core/array.h"
#include "sessile/core/lanes.h"

namespace sessile::ceiling {
namespace {

constexpr std::size_t unroll = 8;
constexpr std::size_t lanes = static_cast<std::size_t>(lane_count);

/// How many numbers each thread takes, whole unrolled turns of them, for so many bytes in all.
std::size_t share(std::size_t bytes, int threads) {
  const std::size_t turn = unroll * lanes;
  return std::max(turn, bytes / sizeof(Real) / static_cast<std::size_t>(threads) / turn * turn);
}

}  // namespace

double read_bandwidth(std::size_t bytes, int threads, double seconds) {
  const std::size_t n = share(bytes, threads);
  const double round = seconds_a_round(threads, seconds, [n] {
    return [data = Array<Real>(n, Real(1)), n] {
      std::array<Lanes, unroll> sums;
      sums.fill(Lanes(Real(0)));
      for (std::size_t i = 0; i < n; i += unroll * lanes) {
        for (std::size_t k = 0; k < unroll; ++k) sums[k] += Lanes::load_aligned(&data[i + k * lanes]);
      }
      keep(sums);
    };
  });
  return static_cast<double>(n * sizeof(Real)) * threads / (1e9 * round);
}

double triad_bandwidth(std::size_t bytes, int threads, double seconds) {
  const std::size_t n = share(bytes / 3, threads);
  const double round = seconds_a_round(threads, seconds, [n] {
    return [a = Array<Real>(n, Real(0)), b = Array<Real>(n, Real(1)), c = Array<Real>(n, Real(2)), n]() mutable {
      const Lanes scale(Real(3));
      for (std::size_t i = 0; i < n; i += lanes) {
        const Lanes sum = xsimd::fma(scale, Lanes::load_aligned(&c[i]), Lanes::load_aligned(&b[i]));
        sum.store_aligned(&a[i]);
      }
      keep(a);
    };
  });
  return 3 * static_cast<double>(n * sizeof(Real)) * threads / (1e9 * round);
}

}  // namespace sessile::ceiling
