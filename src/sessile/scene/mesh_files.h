#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "sessile/core/vec.h"

namespace sessile {

/// Corners and triangles as a file lists them.
struct TriangleSoup {
  std::vector<Vec3d> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The surface in the text of a Wavefront OBJ file: its lines "v" and "f", polygons as fans. Nothing that the file
/// names is opened. Throws FileError with what is wrong, without the file's name; so do the others.
TriangleSoup parse_obj(std::string_view text);

/// The surface in an STL file, as text or binary.
TriangleSoup parse_stl(std::string_view bytes);

/// The surface in a PLY file, as text or binary of either byte order: x, y, z of "vertex", the indices of "face".
TriangleSoup parse_ply(std::string_view bytes);

/// Polygons as a file lists them, one behind the other: a file of millions of empty ones takes little.
class Polygons {
 public:
  void begin() { begins_.push_back(corners_.size()); }            ///< begins the next polygon
  void corner(std::int64_t index) { corners_.push_back(index); }  ///< adds to it
  std::size_t size() const { return begins_.size(); }
  std::span<const std::int64_t> operator[](std::size_t i) const {
    const std::size_t end = i + 1 < begins_.size() ? begins_[i + 1] : corners_.size();
    return std::span(corners_).subspan(begins_[i], end - begins_[i]);
  }

 private:
  std::vector<std::int64_t> corners_;
  std::vector<std::size_t> begins_;
};

/// Most corners, and most triangles, of a mesh. A file of 1 GiB could else stand for a hundred.
inline constexpr std::size_t most_mesh_parts = 50'000'000;

/// Throws FileError when there are more than most_mesh_parts.
void check_parts(std::size_t count, std::string_view what);

/// Adds a polygon as a fan of triangles. A bent or concave one keeps its border, so a closed surface stays closed.
/// Throws FileError when an index is not of a corner.
void add_polygon(TriangleSoup& soup, std::span<const std::int64_t> polygon);

}  // namespace sessile
