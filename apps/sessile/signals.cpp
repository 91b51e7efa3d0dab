#include "signals.h"

#include <csignal>
#include <mutex>

namespace sessile::app {
namespace {

// Set by the signal handler, which may touch nothing else.
volatile std::sig_atomic_t stop_flag = 0;

}  // namespace

void heed_signals() {
  static std::once_flag once;  // a signal between two runs must not be forgotten
  std::call_once(once, [] {
    const auto ask = [](int signal) {
      stop_flag = 1;
      std::signal(signal, SIG_DFL);
    };
    std::signal(SIGINT, ask);
    std::signal(SIGTERM, ask);
    std::signal(SIGPIPE, [](int) { stop_flag = 1; });  // whoever read along has gone, as with Ctrl-C
    std::signal(SIGXFSZ, SIG_IGN);  // a file size limit then is an error of the write, with a sentence
  });
}

bool stop_asked() { return stop_flag != 0; }

}  // namespace sessile::app
