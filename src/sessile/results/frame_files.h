#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "sessile/output/snapshot.h"

/// The files of frames, by their bytes. What is wrong with one is thrown as FileError without its name.
namespace sessile {

/// All bytes of a file of at most `most` bytes. Throws FileError with its path.
std::string file_bytes(const std::filesystem::path& file, std::uintmax_t most);

/// The first bytes of a file, `most` of them or all that there are. Throws FileError with its path.
std::string first_bytes(const std::filesystem::path& file, std::size_t most);

/// When a frame was taken.
struct FrameMoment {
  double time = 0;  ///< [s]
  std::int64_t step = 0;
};

/// The moment that the beginning of a .vtp or .ply file tells; nothing where it tells none.
std::optional<FrameMoment> vtp_moment(std::string_view beginning);
std::optional<FrameMoment> ply_moment(std::string_view beginning);

/// The particles in a .vtp file that encode_vtp() wrote; the bytes are used up. `most`: bytes that its arrays may
/// unpack to; 0 for an eighth of the memory there is for this process.
Snapshot parse_vtp_frame(std::string bytes, std::uint64_t most = 0);

/// The particles in a .ply file that encode_ply() wrote. Units come from the columns' names: the format has none.
Snapshot parse_ply_frame(std::string_view bytes);

/// Bytes of base64 text. Throws FileError for a text that is none.
std::string base64_bytes(std::string_view text);

}  // namespace sessile
