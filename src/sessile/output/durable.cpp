#include "sessile/output/durable.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "sessile/core/error.h"
#include "sessile/output/file.h"

namespace sessile {
namespace {

/// Returns 0 or the error; a file system that cannot sync a folder is no error.
int sync_descriptor(int folder) {
  while (::fsync(folder) != 0) {
    if (errno == EINTR) continue;
    return errno == EINVAL || errno == ENOTSUP || errno == ENOSYS ? 0 : errno;
  }
  return 0;
}

}  // namespace

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const int error = descriptor < 0 ? errno : sync_descriptor(descriptor);
  if (descriptor >= 0) ::close(descriptor);
  if (error == 0) return;
  const std::error_code reason(error, std::generic_category());
  throw FileError(fmt::format("cannot write the folder {}: {}", folder.string(), reason.message()), reason);
}

void write_durably(const std::filesystem::path& path, std::string_view bytes) {
  write_whole(path, bytes);
  sync_folder(path.has_parent_path() ? path.parent_path() : ".");
}

}  // namespace sessile
