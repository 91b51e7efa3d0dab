#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace sessile {

/// Writes a file whole or not at all: under a temporary name in the same folder, then synced and renamed over `path`.
/// A link of either name is replaced, never followed; a device is written as it is, without a temporary file.
/// Throws FileError with the path and the system's reason; the old file, if any, then stays and nothing else is left.
void write_whole(const std::filesystem::path& path, std::string_view bytes);

/// The name in the same folder under which a file is written before it takes its own: `.file.part`.
std::filesystem::path part_name(const std::filesystem::path& path);

/// Syncs what has been written under a file's part name, and gives it the file's own.
/// Throws FileError, also where a device has that name; then nothing of it is left.
void finish_part(const std::filesystem::path& path);

/// Makes the folder, and those above it, if they are missing.
/// Throws FileError when that fails, when `path` is something else, or when nothing may be written into it.
void create_output_folder(const std::filesystem::path& path);

/// How much of a file stays that is gone on with [bytes].
struct Keep {
  explicit Keep(std::uint64_t length) : bytes(length) {}
  std::uint64_t bytes;
};

/// A file that grows by whole lines. What has been appended stays good whenever the program ends.
class LineFile {
 public:
  /// Makes `path` anew and empty; a link of that name is replaced. Throws FileError.
  explicit LineFile(std::filesystem::path path);

  /// Opens `path` as it is and takes back what follows the part that stays.
  /// Throws FileError, also when it is not as long as that.
  LineFile(std::filesystem::path path, Keep keep);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Hands one line, which ends in a newline, to the system in one piece.
  /// Throws FileError when it could not be written in full, the part that was is taken back, and when the file has been
  /// removed meanwhile.
  void append(std::string_view line);

  /// Asks the disk to keep what has been appended. Throws FileError, also when the file has been removed.
  void sync() const;
  std::uint64_t size() const { return size_; }  ///< [bytes]

 private:
  void refuse_if_removed() const;

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace sessile
