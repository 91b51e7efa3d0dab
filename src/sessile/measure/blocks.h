#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sessile {

/// Particles per block of a sum. Fixed, so that sums add up in the same order on any number of threads.
inline constexpr std::size_t measure_block = 4096;

/// Calls f(begin, end, part) for each block of [0, n), on all threads, and returns the parts in order.
/// f fills a part that starts as Part{}; it must not throw.
template <class Part, class F>
std::vector<Part> measure_blocks(std::size_t n, F&& f) {
  const std::size_t blocks = (n + measure_block - 1) / measure_block;
  std::vector<Part> parts(blocks);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t begin = block * measure_block;
    f(begin, std::min(n, begin + measure_block), parts[block]);
  }
  return parts;
}

}  // namespace sessile
