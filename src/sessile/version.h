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
  std::string isa;       ///< instruction set that a step is compiled for, as -march names it: "x86-64-v3"
  std::string simd;      ///< the part of it that lanes use: "fma3+avx2"
  int lanes = 0;         ///< numbers computed at once
  int real_bits = 0;     ///< 32 or 64
};

BuildInfo build_info();

}  // namespace sessile
