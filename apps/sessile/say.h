#pragma once

#include <cstdio>
#include <string>

namespace sessile::app {

/// Tells the user something, or nobody when the stream is closed or full: a run must not fail for that, and fmt::print
/// would throw.
inline void say(std::FILE* stream, const std::string& text) {
  std::fputs(text.c_str(), stream);
  std::fflush(stream);
}

}  // namespace sessile::app
