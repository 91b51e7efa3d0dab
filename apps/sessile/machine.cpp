#include "machine.h"

#include <malloc.h>

#include <fstream>
#include <sstream>
#include <string_view>

namespace sessile::app {
namespace {

/// The number of kB behind `key:` in a file of such lines, in bytes; 0 where there is none.
std::size_t kilobytes(const char* file, std::string_view key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    std::istringstream rest(line.substr(key.size()));
    std::size_t value = 0;
    return rest >> value ? 1024 * value : 0;
  }
  return 0;
}

}  // namespace

std::string processor_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::size_t available_memory() { return kilobytes("/proc/meminfo", "MemAvailable:"); }

std::size_t resident_memory() {
  malloc_trim(0);  // what has been freed, but is kept for later, is not held
  return kilobytes("/proc/self/status", "VmRSS:");
}

bool forget_peak_memory() {
  std::ofstream out("/proc/self/clear_refs");
  out << "5" << std::flush;
  return out.good();
}

}  // namespace sessile::app
