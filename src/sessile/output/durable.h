#pragma once

#include <filesystem>
#include <string_view>

namespace sessile {

/// Asks the disk to keep the names in a folder: what has been made, renamed or removed there. Throws FileError.
void sync_folder(const std::filesystem::path& folder);

/// Like write_whole, and returns only when the disk has the file under its name as well: a power cut does not take it
/// away any more. Throws FileError.
void write_durably(const std::filesystem::path& path, std::string_view bytes);

}  // namespace sessile
