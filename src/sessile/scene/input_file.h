#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace sessile {

/// What may be read. A pipe is what `<(command)` of a shell hands over.
enum class Input { file, file_or_pipe };

/// All bytes of a file of at most `most` bytes. A folder, a device or a pipe without a writer is refused, never waited
/// for. Throws FileError with the reason alone: "it is a folder", "it is larger than 64 MiB", or the system's.
std::string read_input(const std::filesystem::path& file, std::uintmax_t most, Input allowed = Input::file);

/// The first bytes of a file, `most` of them or all that there are. Throws as read_input().
std::string read_beginning(const std::filesystem::path& file, std::size_t most);

/// A stream of a file that is too long to be read at once. Of anything but a file, which is not waited for, and where
/// it cannot be opened, one that has failed already.
std::ifstream stream_of(const std::filesystem::path& file);

}  // namespace sessile
