#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sessile/output/snapshot.h"

namespace sessile {

/// A file format of frames: its extension is its name in a scene.
struct FrameFormat {
  std::string_view name;
  std::string_view summary;
  std::string (*encode)(const Snapshot&);  ///< the bytes of a whole file; throws Error for what the format cannot hold
};

/// Every format that a scene can list under output.formats.
std::span<const FrameFormat> frame_formats();

/// The format of that name, or null.
const FrameFormat* find_frame_format(std::string_view name);

/// File name of a frame: frame_000012.vtp.
std::string frame_file_name(std::int64_t number, std::string_view format);

/// File name of the solids' samples: solids.vtp.
std::string solids_file_name(std::string_view format);

/// VTK PolyData in XML: one vertex per particle, columns as point data with their units, time as TimeValue. The arrays
/// are appended, compressed by zlib in blocks, and base64 encoded. Opens in ParaView.
std::string encode_vtp(const Snapshot& snapshot);

/// Binary little-endian PLY: x y z, then the columns as properties; velocity as vx vy vz, normal as nx ny nz, other
/// vectors as name_x name_y name_z. Throws Error when a whole number does not fit the format's 32 bits.
std::string encode_ply(const Snapshot& snapshot);

/// A frame of a collection.
struct TimedFile {
  double time;  ///< [s]
  std::string file;
};

/// ParaView collection (.pvd) that gives each file its physical time [s].
std::string encode_pvd(std::span<const TimedFile> frames);

/// The collection of a run's frames, which are numbered from 0: its file's name, and its text for their times [s].
inline constexpr std::string_view collection_file_name = "frames.pvd";
std::string encode_collection(std::span<const double> times);

}  // namespace sessile
