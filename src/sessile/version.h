#pragma once

#include <string>
#include <string_view>

namespace sessile {

/// Version of the library, "0.1.0".
std::string_view version();

/// How the library was built.
struct BuildInfo {
  std::string version;
  std::string compiler;  ///< name and version
  std::string type;      ///< "optimised" or "debug"
  std::string simd;      ///< instruction set of the kernels
  int lanes = 0;         ///< numbers computed at once
  int real_bits = 0;     ///< 32 or 64
};

BuildInfo build_info();

}  // namespace sessile
