#include "sessile/output/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "sessile/core/error.h"
#include "sessile/scene/input_file.h"

namespace sessile {
namespace {

namespace fs = std::filesystem;

FileError failure(std::string_view what, const fs::path& path, int error) {
  const std::error_code reason(error, std::generic_category());
  return FileError(fmt::format("cannot {} {}: {}", what, path.string(), reason.message()), reason);
}

/// Opens, or returns -1 with errno. Descriptors do not leak into programs that are started meanwhile.
int open_descriptor(const fs::path& path, int flags) {
  int descriptor;
  do {
    descriptor = ::open(path.c_str(), O_CLOEXEC | flags, 0666);
  } while (descriptor < 0 && errno == EINTR);
  return descriptor;
}

/// Whether a name stands for what is no file: a device, or anything in /dev, where links lead on to devices and pipes.
/// It is written into as it is. Another link is never followed, even to a device.
bool is_device(const fs::path& path) {
  struct stat there {};
  if (::lstat(path.c_str(), &there) == 0 && (S_ISCHR(there.st_mode) || S_ISBLK(there.st_mode))) return true;
  std::error_code unknown;
  return fs::canonical(path.has_parent_path() ? path.parent_path() : ".", unknown) == "/dev";
}

/// Opens a file that is new: what stands there, a link of either kind or a pipe too, gives way and is not written into.
/// A device is opened as it is. Returns -1 with errno.
int open_anew(const fs::path& path, int flags) {
  if (is_device(path)) return open_descriptor(path, O_WRONLY | O_NOCTTY | flags);
  if (::unlink(path.c_str()) != 0 && errno != ENOENT) return -1;
  return open_descriptor(path, O_WRONLY | O_CREAT | O_NOFOLLOW | O_EXCL | flags);
}

/// Opens a file to go on with. One that is a link, of either kind, gives way to a copy of its first bytes; a pipe is
/// not waited for. Returns -1 with errno.
int open_again(const fs::path& path, std::uint64_t bytes) {
  struct stat there {};
  if (::lstat(path.c_str(), &there) != 0) return -1;
  if (S_ISLNK(there.st_mode) || (S_ISREG(there.st_mode) && there.st_nlink > 1)) {
    std::string kept;
    try {
      kept = read_beginning(path, static_cast<std::size_t>(bytes));
    } catch (const FileError& fault) {
      throw FileError(fmt::format("cannot go on with {}: {}", path.string(), fault.what()));
    }
    write_whole(path, kept);
  }
  return open_descriptor(path, O_WRONLY | O_APPEND | O_NOFOLLOW | O_NONBLOCK);
}

/// Writes all bytes. Returns 0 or the error.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    if (n == 0) return ENOSPC;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

/// Asks the disk to keep what was written. Returns 0 or the error; a file system that knows no sync is no error.
int sync(int descriptor) {
  while (::fsync(descriptor) != 0) {
    if (errno == EINTR) continue;
    return errno == EINVAL || errno == ENOTSUP || errno == ENOSYS ? 0 : errno;
  }
  return 0;
}

/// Returns 0 or the error.
int write_device(const fs::path& path, std::string_view bytes) {
  const int descriptor = open_anew(path, 0);
  if (descriptor < 0) return errno;
  int error = write_all(descriptor, bytes);
  if (error == 0) error = sync(descriptor);
  if (::close(descriptor) != 0 && error == 0 && errno != EINTR) error = errno;
  return error;
}

}  // namespace

fs::path part_name(const fs::path& path) {
  // The name is the same at every attempt, so that what a killed run left behind is used up by the next one.
  return path.parent_path() / fmt::format(".{}.part", path.filename().string());
}

void finish_part(const fs::path& path) {
  const fs::path temporary = part_name(path);
  const int descriptor = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  int error = descriptor < 0 ? errno : sync(descriptor);
  if (descriptor >= 0) ::close(descriptor);
  if (error == 0 && is_device(path)) error = EEXIST;  // it would be replaced by a file
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(temporary.c_str());
  throw failure("write", path, error);
}

void write_whole(const fs::path& path, std::string_view bytes) {
  if (is_device(path)) {
    if (const int error = write_device(path, bytes)) throw failure("write", path, error);
    return;
  }
  const fs::path temporary = part_name(path);
  const int descriptor = open_anew(temporary, 0);
  if (descriptor < 0) throw failure("write", path, errno);
  int error = write_all(descriptor, bytes);
  if (error == 0) error = sync(descriptor);
  // Some file systems report a full disk only here. After EINTR the descriptor is closed all the same.
  if (::close(descriptor) != 0 && error == 0 && errno != EINTR) error = errno;
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    throw failure("write", path, error);
  }
}

void create_output_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  std::error_code unknown;  // where it cannot even be asked, the first error tells why
  const bool is_folder = fs::is_directory(path, unknown);
  if (!is_folder && !error) error = std::make_error_code(std::errc::not_a_directory);
  if (!is_folder) throw failure("create the folder", path, error.value());
  if (::access(path.c_str(), W_OK | X_OK) != 0) throw failure("write into the folder", path, errno);
}

LineFile::LineFile(fs::path path) : path_(std::move(path)), descriptor_(open_anew(path_, O_APPEND)) {
  if (descriptor_ < 0) throw failure("write", path_, errno);
}

LineFile::LineFile(fs::path path, Keep keep)
    : path_(std::move(path)), descriptor_(open_again(path_, keep.bytes)), size_(keep.bytes) {
  if (descriptor_ < 0) throw failure("go on with", path_, errno);
  struct stat now {};
  int error = ::fstat(descriptor_, &now) == 0 ? 0 : errno;
  const bool shorter = error == 0 && static_cast<std::uint64_t>(now.st_size) < keep.bytes;
  if (error == 0 && !shorter && ::ftruncate(descriptor_, static_cast<off_t>(keep.bytes)) != 0) error = errno;
  if (error == 0 && !shorter) return;
  ::close(descriptor_);
  if (shorter) throw FileError(fmt::format("cannot go on with {}: it is shorter than it was", path_.string()));
  throw failure("go on with", path_, error);
}

LineFile::~LineFile() { ::close(descriptor_); }

/// What is appended to a file without a name is gone when the run ends, and no call would ever fail for that.
void LineFile::refuse_if_removed() const {
  struct stat now {};
  if (::fstat(descriptor_, &now) != 0 || now.st_nlink > 0) return;
  throw FileError(fmt::format("{} has been removed while it was written", path_.string()),
                  std::error_code(ENOENT, std::generic_category()));
}

void LineFile::append(std::string_view line) {
  refuse_if_removed();
  struct stat before {};
  const bool known = ::fstat(descriptor_, &before) == 0;
  if (const int error = write_all(descriptor_, line)) {
    // Half a line would be read as a line of wrong numbers. When even this fails there is no more to be done.
    if (known && S_ISREG(before.st_mode)) static_cast<void>(!::ftruncate(descriptor_, before.st_size));
    throw failure("write", path_, error);
  }
  size_ += line.size();
}

void LineFile::sync() const {
  refuse_if_removed();
  if (const int error = sessile::sync(descriptor_)) throw failure("write", path_, error);
}

}  // namespace sessile
