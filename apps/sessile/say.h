#pragma once

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string>

#include "signals.h"

namespace sessile::app {

/// Waits until the stream takes some bytes; false when a signal asks for the end before it does. A pipe that nobody
/// reads would keep the program in its write, which goes on after a signal.
inline bool has_room(std::FILE* stream) {
  constexpr int slice = 100;  // ms
  pollfd asked{fileno(stream), POLLOUT, 0};
  for (;;) {
    const int ready = poll(&asked, 1, slice);
    if (ready > 0 || (ready < 0 && errno != EINTR)) return true;  // the write itself says what is wrong
    if (stop_asked()) return false;
  }
}

/// Tells the user something, or nobody when the stream is closed or full: a run must not fail for that, and fmt::print
/// would throw.
inline void say(std::FILE* stream, const std::string& text) {
  constexpr std::size_t piece = 4096;  // which a pipe takes at once when it takes anything: PIPE_BUF
  for (std::size_t begin = 0; begin < text.size(); begin += piece) {
    if (!has_room(stream)) return;
    std::fwrite(text.data() + begin, 1, std::min(piece, text.size() - begin), stream);
    std::fflush(stream);
  }
}

}  // namespace sessile::app
