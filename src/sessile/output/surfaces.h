#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "sessile/scene/mesh.h"
#include "sessile/surface/surface_mesh.h"

namespace sessile {

/// A file format of surfaces: its extension is its name in a scene.
struct SurfaceFormat {
  std::string_view name;
  std::string_view summary;
  /// The bytes of a file of one frame; throws Error for what the format cannot hold. Null where the file is made by
  /// other means: "usda" holds all frames (UsdaWriter), "vdb" wants OpenVDB, which the program brings.
  std::string (*encode)(const SurfaceMesh&);
};

/// Every format that a scene can list under output.surface.formats.
std::span<const SurfaceFormat> surface_formats();

/// The format of that name, or null.
const SurfaceFormat* find_surface_format(std::string_view name);

/// File name of a frame's surface: surface_000012.ply.
std::string surface_file_name(std::int64_t number, std::string_view format);

/// Binary little-endian PLY: x y z, nx ny nz where there are normals, the columns as those of frames, and triangles
/// as faces. Throws Error when a whole number does not fit the format's 32 bits.
std::string encode_surface_ply(const SurfaceMesh& mesh);

/// Wavefront OBJ: lines v, vn and f; it has no place for columns.
std::string encode_surface_obj(const SurfaceMesh& mesh);

/// VTK PolyData in XML: triangles, the normals and columns as point data, time as TimeValue. Opens in ParaView.
std::string encode_surface_vtp(const SurfaceMesh& mesh);

/// A mesh of the scene as a surface without normals or columns.
SurfaceMesh as_surface(const TriangleMesh& mesh);

}  // namespace sessile
