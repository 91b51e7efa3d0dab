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

}  // namespace

FolderLock::FolderLock(fs::path folder) : folder_(std::move(folder)) {
  create_output_folder(folder_);
  directory_ = Descriptor(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const auto failure = [&](int error) {
    return FileError(fmt::format("cannot lock the folder {}: {}", folder_.string(), reason(error)),
                     std::error_code(error, std::generic_category()));
  };
  if (!directory_.open()) throw failure(errno);
  for (;;) {
    // For writing too: over NFS an exclusive lock takes that.
    file_ = Descriptor(::openat(directory_.number(), file_name, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
    if (!file_.open()) throw failure(errno);
    const int error = lock(file_.number());
    if (error == EWOULDBLOCK) throw in_use(folder_, owner_in(file_.number()));
    if (error != 0) {
      warning_ = fmt::format(
          "{}: this file system knows no locks ({}); see to it that no other run writes into the same folder",
          folder_.string(), reason(error));
    }
    struct stat locked {};
    // Whoever had it before has taken the file out meanwhile: the lock on it keeps nobody out.
    if (::fstat(file_.number(), &locked) == 0 && locked.st_nlink > 0) break;
  }
  const std::string owner = fmt::format("{} {}\n", getpid(), machine_name());
  // It says whom to ask, and the lock holds without it: on a full disk the run's own files will say so.
  const bool written = ::ftruncate(file_.number(), 0) == 0 &&
                       ::pwrite(file_.number(), owner.data(), owner.size(), 0) == static_cast<ssize_t>(owner.size());
  static_cast<void>(written);
}

FolderLock::~FolderLock() {
  // While it is locked still, so that nobody else can have locked what is taken out.
  ::unlinkat(directory_.number(), file_name, 0);
}

bool FolderLock::in_place() const {
  struct stat held {
  }, named{};
  return ::fstat(directory_.number(), &held) == 0 && ::stat(folder_.c_str(), &named) == 0 && same(held, named);
}

void FolderLock::check() const {
  if (in_place()) return;
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
  const Descriptor file(::open((folder / FolderLock::file_name).c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW));
  if (file.open() && lock(file.number()) == EWOULDBLOCK) throw in_use(folder, owner_in(file.number()));
}

}  // namespace sessile::app
