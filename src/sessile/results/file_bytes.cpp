#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "sessile/core/error.h"
#include "sessile/results/frame_files.h"

namespace sessile {

std::string file_bytes(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw FileError(fmt::format("cannot read {}: {}", file.string(), error.message()));
  return first_bytes(file, size);
}

std::string first_bytes(const std::filesystem::path& file, std::size_t most) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw FileError(fmt::format("cannot read {}: {}", file.string(), error.message()));
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(std::min<std::uintmax_t>(most, size), '\0');
  if (!stream || !stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    throw FileError(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno)));
  }
  return bytes;
}

}  // namespace sessile
