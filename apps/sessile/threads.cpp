#include "threads.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "say.h"

namespace sessile::app {
namespace {

/// How many threads beside this one can be had at the same time, at most `wanted`, and why there are no more.
std::pair<int, std::error_code> try_threads(int wanted) {
  std::mutex mutex;
  std::condition_variable changed;
  bool enough = false;
  std::vector<std::jthread> threads;
  // Before they are joined, however this ends.
  struct Release {
    std::mutex& mutex;
    std::condition_variable& changed;
    bool& enough;
    ~Release() {
      {
        const std::lock_guard lock(mutex);
        enough = true;
      }
      changed.notify_all();
    }
  };
  const Release release{mutex, changed, enough};
  threads.reserve(static_cast<std::size_t>(wanted));
  std::error_code reason;
  try {
    while (static_cast<int>(threads.size()) < wanted) {
      threads.emplace_back([&] {
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return enough; });
      });
    }
  } catch (const std::system_error& e) {
    reason = e.code();
  }
  return {static_cast<int>(threads.size()), reason};
}

}  // namespace

void use_threads(int wanted) {
  if (wanted > 0) omp_set_num_threads(wanted);
  // One more is for files, which a run writes meanwhile.
  const int all = omp_get_max_threads();
  const auto [had, reason] = try_threads(all);
  if (!reason) return;
  const int rest = std::max(1, had);
  if (rest == all) return;
  say(stderr,
      fmt::format("warning: {} threads instead of {}, which cannot be started: {}\n", rest, all, reason.message()));
  omp_set_num_threads(rest);
}

}  // namespace sessile::app
