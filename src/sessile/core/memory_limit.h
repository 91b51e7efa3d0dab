#pragma once

#include <filesystem>
#include <string>

namespace sessile {

/// How much memory a process may come to use, and what says so: "this machine has", "the limit on address space
/// (ulimit -v) is" ...
struct MemoryLimit {
  double bytes = 0;
  std::string what;
};

/// The least of the machine's memory, the process's limit on its address space, and the limits of the control groups
/// (version 1 or 2) that it is in. Other processes' use does not count. The two places are for tests.
MemoryLimit memory_limit(const std::filesystem::path& groups_of_process = "/proc/self/cgroup",
                         const std::filesystem::path& groups = "/sys/fs/cgroup");

}  // namespace sessile
