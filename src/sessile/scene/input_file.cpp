#include "sessile/scene/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <system_error>

#include "sessile/core/error.h"

namespace sessile {
namespace {

FileError system_says(int error) { return FileError(std::generic_category().message(error)); }

void refuse_odd(const struct stat& status, Input allowed) {
  if (S_ISDIR(status.st_mode)) throw FileError("it is a folder");
  if (S_ISREG(status.st_mode) || (S_ISFIFO(status.st_mode) && allowed == Input::file_or_pipe)) return;
  throw FileError(S_ISFIFO(status.st_mode)   ? "it is a pipe"
                  : S_ISSOCK(status.st_mode) ? "it is a socket"
                                             : "it is a device");
}

class OpenFile {
 public:
  OpenFile(const std::filesystem::path& file, Input allowed) {
    struct stat status {};
    // Asked before it is opened too, as opening alone makes some devices do things.
    if (::stat(file.c_str(), &status) != 0) throw system_says(errno);
    refuse_odd(status, allowed);
    // A pipe is opened without waiting for its writer.
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    if (descriptor_ < 0) throw system_says(errno);
    try {
      if (::fstat(descriptor_, &status) != 0) throw system_says(errno);
      refuse_odd(status, allowed);
      if (::fcntl(descriptor_, F_SETFL, 0) != 0) throw system_says(errno);
    } catch (...) {
      ::close(descriptor_);
      throw;
    }
    size_ = S_ISREG(status.st_mode) ? static_cast<std::uintmax_t>(status.st_size) : 0;
  }
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  std::uintmax_t size() const { return size_; }  ///< by its folder's account; 0 of a pipe

  /// Up to `most` bytes.
  std::string read(std::uintmax_t most) const {
    std::string bytes;
    bytes.reserve(static_cast<std::size_t>(std::min(size_, most)));
    std::array<char, 1 << 16> block;
    while (bytes.size() < most) {
      const std::size_t wanted = static_cast<std::size_t>(std::min<std::uintmax_t>(block.size(), most - bytes.size()));
      const ssize_t n = ::read(descriptor_, block.data(), wanted);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) throw system_says(errno);
      if (n == 0) break;
      bytes.append(block.data(), static_cast<std::size_t>(n));
    }
    return bytes;
  }

 private:
  int descriptor_ = -1;
  std::uintmax_t size_ = 0;
};

}  // namespace

std::string read_input(const std::filesystem::path& file, std::uintmax_t most, Input allowed) {
  const OpenFile open(file, allowed);
  const auto too_large = [&] { return FileError(fmt::format("it is larger than {} MiB", most >> 20U)); };
  if (open.size() > most) throw too_large();
  std::string bytes = open.read(most == std::numeric_limits<std::uintmax_t>::max() ? most : most + 1);
  if (bytes.size() > most) throw too_large();
  return bytes;
}

std::ifstream stream_of(const std::filesystem::path& file) {
  std::error_code error;
  std::ifstream stream;
  if (std::filesystem::is_regular_file(file, error)) {
    stream.open(file, std::ios::binary);
  } else {
    stream.setstate(std::ios::failbit);
  }
  return stream;
}

std::string read_beginning(const std::filesystem::path& file, std::size_t most) {
  return OpenFile(file, Input::file).read(most);
}

}  // namespace sessile
