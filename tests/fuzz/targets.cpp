#include "fuzz/targets.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "sessile/core/error.h"

namespace sessile::fuzz {

void survive(void (*read)(std::string_view), std::string_view bytes) {
  try {
    read(bytes);
  } catch (const Error& error) {
    must(*error.what() != '\0', "an error says nothing");
  }
}

void must(bool right, std::string_view what) {
  if (right) return;
  fmt::print(stderr, "broken promise: {}\n", what);
  std::abort();
}

}  // namespace sessile::fuzz
