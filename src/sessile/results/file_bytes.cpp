#include <fmt/format.h>

#include "sessile/core/error.h"
#include "sessile/results/frame_files.h"
#include "sessile/scene/input_file.h"

namespace sessile {
namespace {

template <class Read>
std::string read_named(const std::filesystem::path& file, Read&& read) {
  try {
    return read();
  } catch (const FileError& fault) {
    throw FileError(fmt::format("cannot read {}: {}", file.string(), fault.what()));
  }
}

}  // namespace

std::string file_bytes(const std::filesystem::path& file, std::uintmax_t most) {
  return read_named(file, [&] { return read_input(file, most); });
}

std::string first_bytes(const std::filesystem::path& file, std::size_t most) {
  return read_named(file, [&] { return read_beginning(file, most); });
}

}  // namespace sessile
