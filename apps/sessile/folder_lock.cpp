#include "folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <sstream>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "sessile/output/file.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

/// How often a lock is tried that another process holds, and the pause between: that process may only be asking, or may
/// not have written yet who it is.
constexpr int trials = 10;
constexpr std::chrono::milliseconds pause{10};

std::string reason(int error) { return std::generic_category().message(error); }

std::string machine_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "this machine";
}

std::string owner_in(int file) {
  std::array<char, 512> text{};
  const ssize_t size = ::pread(file, text.data(), text.size() - 1, 0);
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string();
}

FolderInUse in_use(const fs::path& folder, const std::string& owner) {
  std::istringstream words(owner);
  long process = 0;
  std::string machine;
  std::string who = "another process", how;
  if (words >> process >> machine) {
    who = fmt::format("process {} on {}", process, machine);
    if (machine == machine_name()) how = fmt::format(", end it with `kill {}`", process);
  }
  return FolderInUse(
      fmt::format("{}: {} writes into this folder; wait until it is done{}, or give another folder with -o",
                  folder.string(), who, how));
}

/// Takes the lock. Returns 0, EWOULDBLOCK when another process has it, or why there can be none.
int lock(int file) {
  for (int trial = 1;; ++trial) {
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) return 0;
    if (errno == EINTR) continue;
    if (errno != EWOULDBLOCK || trial == trials) return errno;
    std::this_thread::sleep_for(pause);
  }
}

bool same(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

FileError failure(std::string_view what, const fs::path& folder, int error) {
  return FileError(fmt::format("cannot {} the folder {}: {}", what, folder.string(), reason(error)),
                   std::error_code(error, std::generic_category()));
}

/// Opens the lock file; for writing too, which an exclusive lock takes over NFS. -1 with errno.
int open_lock_file(int directory, int flags) {
  return ::openat(directory, FolderLock::file_name, O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | flags, 0666);
}

/// Whether the name of the lock file still leads to this one.
bool is_named(int directory, const struct stat& file) {
  struct stat named {};
  return ::fstatat(directory, FolderLock::file_name, &named, AT_SYMLINK_NOFOLLOW) == 0 && same(file, named);
}

/// Who holds the folder, as its lock file says. Nothing where there is no such file, or it is none of ours.
std::string owner_of(int directory) {
  const Descriptor file(open_lock_file(directory, 0));
  return file.open() ? owner_in(file.number()) : std::string();
}

}  // namespace

FolderLock::FolderLock(fs::path folder) : folder_(std::move(folder)) {
  create_output_folder(folder_);
  directory_ = Descriptor(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!directory_.open()) throw failure("lock", folder_, errno);
  // The folder itself too, whose lock holds when the file is removed. Some file systems lock files alone.
  if (lock(directory_.number()) == EWOULDBLOCK) throw in_use(folder_, owner_of(directory_.number()));
  while (!lock_file()) {
  }
  const std::string owner = fmt::format("{} {}\n", getpid(), machine_name());
  // It says whom to ask, and the lock holds without it: on a full disk the run's own files will say so.
  const bool written = ::ftruncate(file_.number(), 0) == 0 &&
                       ::pwrite(file_.number(), owner.data(), owner.size(), 0) == static_cast<ssize_t>(owner.size());
  static_cast<void>(written);
}

/// Opens and locks the file. False: it has to be tried again, with another file of that name.
bool FolderLock::lock_file() {
  const int directory = directory_.number();
  const auto replace = [&] {
    if (::unlinkat(directory, file_name, 0) != 0 && errno != ENOENT) throw failure("lock", folder_, errno);
    return false;
  };
  file_ = Descriptor(open_lock_file(directory, O_CREAT));
  if (!file_.open() && errno == ELOOP) return replace();  // a link, which no lock of ours is
  if (!file_.open()) throw failure("lock", folder_, errno);
  const int error = lock(file_.number());
  if (error == EWOULDBLOCK) throw in_use(folder_, owner_in(file_.number()));
  if (error != 0) {
    warning_ =
        fmt::format("{}: this file system knows no locks ({}); see to it that no other run writes into the same folder",
                    folder_.string(), reason(error));
  }
  struct stat locked {};
  if (::fstat(file_.number(), &locked) != 0) return true;
  // Whoever had it before has taken the file out meanwhile: the lock on it keeps nobody out.
  if (!is_named(directory, locked)) return false;
  // Another name of somebody's file, or a pipe, is not written into. Nobody holds it, or the lock would have told.
  if (!S_ISREG(locked.st_mode) || locked.st_nlink > 1) return replace();
  return true;
}

FolderLock::~FolderLock() {
  // While it is locked still, so that nobody else can have locked what is taken out; and no other file of that name.
  struct stat locked {};
  if (::fstat(file_.number(), &locked) != 0 || !is_named(directory_.number(), locked)) return;
  ::unlinkat(directory_.number(), file_name, 0);
}

/// 0: the folder stands where it did; ENOENT: not any more; else why that cannot be told.
int FolderLock::look() const {
  struct stat held {
  }, named{};
  if (::fstat(directory_.number(), &held) != 0) return errno;
  if (::stat(folder_.c_str(), &named) != 0) return errno == ENOTDIR ? ENOENT : errno;
  return same(held, named) ? 0 : ENOENT;
}

bool FolderLock::in_place() const { return look() == 0; }

void FolderLock::check() const {
  const int error = look();
  if (error == 0) return;
  if (error != ENOENT) throw failure("reach", folder_, error);
  struct stat held {};
  const bool removed = ::fstat(directory_.number(), &held) == 0 && held.st_nlink == 0;
  std::error_code unknown;
  const fs::path now = fs::read_symlink(fmt::format("/proc/self/fd/{}", directory_.number()), unknown);
  const std::error_code gone(ENOENT, std::generic_category());
  if (removed || unknown) {
    throw FileError(fmt::format("the folder {} has been removed while it was written into", folder_.string()), gone);
  }
  throw FileError(fmt::format("the folder {} has been renamed while it was written into; what is there is whole: {}",
                              folder_.string(), now.string()),
                  gone);
}

void refuse_if_in_use(const fs::path& folder) {
  const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!directory.open()) return;
  if (lock(directory.number()) == EWOULDBLOCK) throw in_use(folder, owner_of(directory.number()));
  const Descriptor file(open_lock_file(directory.number(), 0));
  if (file.open() && lock(file.number()) == EWOULDBLOCK) throw in_use(folder, owner_in(file.number()));
}

}  // namespace sessile::app
