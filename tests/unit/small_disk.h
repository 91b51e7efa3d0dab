#pragma once

#include <signal.h>
#include <sys/resource.h>

namespace sessile::test {

/// Files cannot grow beyond `bytes` while this lives: the same as a full disk, without one.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : old_handler_(signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{bytes, old_limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    signal(SIGXFSZ, old_handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  sighandler_t old_handler_;
  rlimit old_limit_{};
};

}  // namespace sessile::test
