#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "sessile/core/first_error.h"

namespace sessile {

/// Particles per unit of parallel work. Blocks do not depend on the number of threads, so neither do results.
inline constexpr std::ptrdiff_t block_size = 512;

constexpr std::ptrdiff_t block_count(std::size_t n) {
  return (static_cast<std::ptrdiff_t>(n) + block_size - 1) / block_size;
}

/// Calls f(block, begin, end) for consecutive ranges of at most block_size out of 0 ... n-1, on all threads.
/// Throws what a call has thrown; blocks are then left out.
template <class F>
void for_each_block(std::size_t n, F&& f) {
  const std::ptrdiff_t blocks = block_count(n);
  const auto last = static_cast<std::ptrdiff_t>(n);
  FirstError error;
#pragma omp parallel for schedule(dynamic, 1)
  for (std::ptrdiff_t block = 0; block < blocks; ++block) {
    error.guard([&] { f(block, block * block_size, std::min(last, (block + 1) * block_size)); });
  }
  error.rethrow();
}

/// Calls kernel(i) for i = 0 ... n-1, on all threads.
template <class Kernel>
void for_each(std::size_t n, const Kernel& kernel) {
  for_each_block(n, [&](std::ptrdiff_t, std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (auto i = begin; i < end; ++i) kernel(static_cast<int>(i));
  });
}

/// Joins value(i) for i = 0 ... n-1 with join(a, b), in an order that does not depend on the number of threads.
template <class T, class Value, class Join>
T reduce(std::size_t n, const T& start, const Value& value, const Join& join) {
  static_assert(!std::is_same_v<T, bool>, "threads cannot write neighbouring bits of a std::vector<bool>");
  std::vector<T> parts(static_cast<std::size_t>(block_count(n)), start);
  for_each_block(n, [&](std::ptrdiff_t block, std::ptrdiff_t begin, std::ptrdiff_t end) {
    T part = start;
    for (auto i = begin; i < end; ++i) part = join(part, value(static_cast<int>(i)));
    parts[static_cast<std::size_t>(block)] = part;
  });
  T all = start;
  for (const T& part : parts) all = join(all, part);
  return all;
}

/// Sum of value(i) in double.
template <class Value>
double sum(std::size_t n, const Value& value) {
  return reduce(n, 0.0, value, [](double a, double b) { return a + b; });
}

/// Greatest value(i), or 0 when none is greater.
template <class Value>
double maximum(std::size_t n, const Value& value) {
  return reduce(n, 0.0, value, [](double a, double b) { return std::max(a, b); });
}

}  // namespace sessile
