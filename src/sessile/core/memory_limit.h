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

/// Memory [bytes] that a run takes for so many particles and boundary particles, its frames among it, above measured
/// figures; what the program takes by itself and surfaces that a run makes are not in it. `support` is the support
/// radius over the spacing: lists of neighbours grow with its cube.
double estimated_bytes(double particles, double support);

/// The least of the machine's memory, the process's limit on its address space, and the limits of the control groups
/// (version 1 or 2) that it is in. Other processes' use does not count. The two places are for tests.
MemoryLimit memory_limit(const std::filesystem::path& groups_of_process = "/proc/self/cgroup",
                         const std::filesystem::path& groups = "/sys/fs/cgroup");

}  // namespace sessile
