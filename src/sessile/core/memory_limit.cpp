#include "sessile/core/memory_limit.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <string_view>

#include "sessile/core/real.h"

namespace sessile {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view by_group = "the limit of its control group (container) is";

void lower(MemoryLimit& limit, double bytes, std::string_view what) {
  if (bytes < limit.bytes) limit = {bytes, std::string(what)};
}

/// The least limit of a group and those above it; a file that is not there, or says "max", limits nothing.
void lower_by_groups(MemoryLimit& limit, const fs::path& root, fs::path group, const char* name) {
  for (;; group = group.parent_path()) {
    double bytes = 0;
    if (std::ifstream file(root / group.relative_path() / name); file >> bytes) lower(limit, bytes, by_group);
    if (!group.has_relative_path()) return;
  }
}

}  // namespace

double estimated_bytes(double particles, double support) {
  constexpr double fields = 450.0 * sizeof(Real) / sizeof(float);  // arrays, and copies of them in frames on their way
  constexpr double fill = 1.15;  // lists are as long as the longest of their group, and grow by eighths
  const double neighbors = 4 * std::numbers::pi / 3 * support * support * support;
  return particles * (fields + fill * sizeof(std::int32_t) * neighbors);
}

MemoryLimit memory_limit(const fs::path& groups_of_process, const fs::path& groups) {
  MemoryLimit limit{static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)),
                    "this machine has"};
  rlimit space{};
  if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY) {
    lower(limit, static_cast<double>(space.rlim_cur), "the limit on its address space (ulimit -v) is");
  }
  // Lines are ID:CONTROLLERS:GROUP; version 2 has the one line 0::GROUP.
  std::ifstream lines(groups_of_process);
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = fmt::format(",{},", line.substr(first + 1, second - first - 1));
    const fs::path group = line.substr(second + 1);
    if (controllers == ",,") lower_by_groups(limit, groups, group, "memory.max");
    if (controllers.find(",memory,") != std::string::npos) {
      lower_by_groups(limit, groups / "memory", group, "memory.limit_in_bytes");
    }
  }
  return limit;
}

}  // namespace sessile
