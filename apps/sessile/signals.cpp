#include "signals.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <mutex>

namespace sessile::app {
namespace {

// A second signal so soon after the first is no second wish [ns]: `timeout` and shells send theirs to the process and
// to its group.
constexpr std::int64_t echo = 200'000'000;

// Set by the signal handlers, which may touch nothing else.
std::atomic<int> first_signal = 0;
std::atomic<std::int64_t> asked_at = 0;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

std::int64_t steady_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

/// Ctrl-C and SIGTERM: who asks twice means at once.
void ask_or_end(int signal) {
  const int error = errno;
  std::int64_t never = 0;
  const std::int64_t now = steady_now();
  if (!asked_at.compare_exchange_strong(never, now) && now - never > echo) {
    ::signal(signal, SIG_DFL);
    ::raise(signal);
  }
  note_stop(signal);
  errno = error;
}

/// Those that come in numbers without anybody being impatient: a closed terminal, and a reader that has gone.
void ask(int signal) { note_stop(signal); }

void heed(int signal, void (*handler)(int)) {
  struct sigaction before {};
  if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

}  // namespace

void prepare_process() {
  ::signal(SIGXFSZ, SIG_IGN);
  // A descriptor that is free would be the next file's, and messages would go into that. These fail when written to, as
  // a closed stream does; each call gives the lowest that is free.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
  }
}

void heed_signals() {
  static std::once_flag once;  // a signal between two runs must not be forgotten
  std::call_once(once, [] {
    heed(SIGINT, ask_or_end);
    heed(SIGTERM, ask_or_end);
    heed(SIGHUP, ask);
    heed(SIGPIPE, ask);  // whoever read along has gone
  });
}

void note_stop(int signal) {
  int none = 0;
  first_signal.compare_exchange_strong(none, signal);
}

bool stop_asked() { return first_signal != 0; }

int interrupted_code() { return 128 + (stop_asked() ? first_signal.load() : SIGINT); }

}  // namespace sessile::app
