#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "sessile/core/error.h"
#include "sessile/simulation_state.h"

namespace sessile {

/// The newest format that this program reads and the one it writes; older ones are read too.
inline constexpr std::uint32_t checkpoint_format = 1;

/// A run as it stood between two steps: all it takes to go on from there, bit for bit.
struct Checkpoint {
  std::string version;     ///< of the program that wrote it
  std::string isa;         ///< instruction set of the steps so far; another one rounds differently
  std::string scene_json;  ///< the resolved scene
  std::string session;     ///< what the program that runs the simulation adds of its own, as JSON
  SimulationState state;
  std::uint32_t format = checkpoint_format;  ///< of the file that it was read from
};

/// A checkpoint that may be as whole as any, and that this program cannot read: of a newer format, or of a build with
/// the other precision.
struct ForeignCheckpoint : FileError {
  using FileError::FileError;
};

/// The file's bytes. All numbers are little-endian:
///   8 bytes "SESSILE\n", u32 format, u32 bytes of a Real, u64 length of the content, u64 checksum (XXH3 of all that
///   stands before it and all that follows), the content as one zstd frame.
std::string encode_checkpoint(const Checkpoint& checkpoint);

/// Reads the bytes of a file; `name` stands for it in messages. `most`: content that is longer is refused [bytes]; 0
/// for a quarter of the memory there is for this process. Throws ForeignCheckpoint, and FileError: not a checkpoint,
/// cut short, damaged, too large.
Checkpoint decode_checkpoint(std::string_view bytes, const std::string& name, std::uint64_t most = 0);

/// Writes it whole or not at all. Throws FileError.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Throws FileError with the path and what is wrong.
Checkpoint read_checkpoint(const std::filesystem::path& file);

/// Whether a file begins as a checkpoint does. False for a file that cannot be read.
bool is_checkpoint(const std::filesystem::path& file);

}  // namespace sessile
