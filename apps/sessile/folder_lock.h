#pragma once

#include <filesystem>
#include <string>

#include "descriptor.h"
#include "sessile/core/error.h"

namespace sessile::app {

/// A folder that another process writes into.
struct FolderInUse : FileError {
  using FileError::FileError;
};

/// Keeps a folder for one process that writes into it, for as long as this lives. The kernel holds the lock and gives
/// it back however the process ends, so that one which was killed locks nobody out. What only reads the folder need not
/// ask.
class FolderLock {
 public:
  /// The file within the folder that is locked beside the folder itself, and names who holds it. A link of that name
  /// gives way to a file.
  static constexpr const char* file_name = ".sessile.lock";

  /// Makes the folder where it is missing. Throws FolderInUse when another process has it, FileError when nothing can
  /// be written into it.
  explicit FolderLock(std::filesystem::path folder);
  ~FolderLock();
  FolderLock(FolderLock&&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;

  /// Why nobody is kept out, on a file system that knows no locks; empty where the lock holds.
  const std::string& warning() const { return warning_; }

  /// Throws FileError when the folder does not stand any more where it did, as what is written from now on would go
  /// astray, or when that cannot be told, with the system's reason.
  void check() const;

  /// Whether check() would pass.
  bool in_place() const;

 private:
  bool lock_file();
  int look() const;

  std::filesystem::path folder_;
  Descriptor directory_, file_;
  std::string warning_;
};

/// Throws FolderInUse when another process writes into the folder now. Makes nothing: for a word in time, before work
/// that would be in vain.
void refuse_if_in_use(const std::filesystem::path& folder);

}  // namespace sessile::app
