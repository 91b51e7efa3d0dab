#include "sessile/core/first_error.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <atomic>
#include <new>
#include <stdexcept>

#include "sessile/core/parallel.h"

namespace sessile {
namespace {

TEST(FirstError, LeavesAParallelLoopAsAnException) {
  for (const int threads : {1, 4}) {
    omp_set_num_threads(threads);
    std::atomic<int> calls = 0;
    const auto run = [&] {
      for_each(200 * block_size, [&](int i) {
        ++calls;
        if (i % block_size == 7) throw std::bad_alloc();
      });
    };
    EXPECT_THROW(run(), std::bad_alloc);
    EXPECT_LE(calls, threads * 8) << "blocks ran on after one had failed";
    EXPECT_THROW(sum(1000, [](int) -> double { throw std::runtime_error("no"); }), std::runtime_error);
  }
}

TEST(FirstError, IsGoneWithTheLoop) {
  EXPECT_THROW(for_each(10, [](int) { throw std::runtime_error("no"); }), std::runtime_error);
  std::atomic<int> calls = 0;
  for_each(10, [&](int) { ++calls; });
  EXPECT_EQ(calls, 10);
}

}  // namespace
}  // namespace sessile
