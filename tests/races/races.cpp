// Proves that a build with ThreadSanitizer sees what it is there for. `races` with the word
//   race       lets two threads add to one number, unguarded: a report is owed;
//   reduction  adds up with reduce(), and reads across threads from loop to loop: none may come.
// ThreadSanitizer knows nothing of OpenMP by itself: without Archer, LLVM's tool that tells it of forks, joins and
// barriers, the second would be reported; without several threads at work, or with all reports suppressed, the first
// would not.
#include <omp.h>

#include <atomic>
#include <cstdio>
#include <string_view>
#include <thread>
#include <vector>

#include "sessile/core/parallel.h"

namespace {

constexpr std::size_t n = 64 * static_cast<std::size_t>(sessile::block_size);

/// Holds each thread until two have come. Relaxed, as an order between the threads would hide the race.
class Meeting {
 public:
  void wait() {
    came_.fetch_or(1U << static_cast<unsigned>(omp_get_thread_num()), std::memory_order_relaxed);
    while (!two(came_.load(std::memory_order_relaxed))) std::this_thread::yield();
  }

 private:
  static bool two(unsigned threads) { return (threads & (threads - 1)) != 0; }
  std::atomic<unsigned> came_{0};
};

double race() {
  Meeting meeting;
  double total = 0;
  sessile::for_each_block(n, [&](std::ptrdiff_t block, std::ptrdiff_t, std::ptrdiff_t) {
    meeting.wait();
    total += static_cast<double>(block);
  });
  return total;
}

double reduction() {
  std::vector<double> written(n), mirrored(n);
  double total = 0;
  for (int turn = 0; turn < 20; ++turn) {
    Meeting meeting;
    sessile::for_each_block(n, [&](std::ptrdiff_t, std::ptrdiff_t begin, std::ptrdiff_t end) {
      meeting.wait();
      for (auto i = begin; i < end; ++i) written[static_cast<std::size_t>(i)] = static_cast<double>(i + turn);
    });
    sessile::for_each(n, [&](int i) {
      const auto k = static_cast<std::size_t>(i);
      mirrored[k] = written[n - 1 - k];
    });
    total += sessile::sum(n, [&](int i) { return mirrored[n - 1 - static_cast<std::size_t>(i)]; });
    written.assign(n, 0);
  }
  return total;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view word = argc == 2 ? argv[1] : "";
  if (omp_get_max_threads() < 2) {
    std::puts("a race takes two threads: set OMP_NUM_THREADS");
    return 2;
  }
  if (word != "race" && word != "reduction") {
    std::puts("usage: races race|reduction");
    return 2;
  }
  std::printf("total %g\n", word == "race" ? race() : reduction());
}
