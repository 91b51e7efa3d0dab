#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sessile/output/snapshot.h"

namespace sessile {

/// The entries of a PLY element as rows of properties, each of four bytes. It keeps views of the numbers it is given.
class PlyRows {
 public:
  explicit PlyRows(std::size_t rows) : rows_(rows) {}

  /// Vectors x y z of each row.
  void vectors(std::span<const float> values, std::string_view x, std::string_view y, std::string_view z);

  /// A column: velocity as vx vy vz and, where `with_normal`, normal as nx ny nz, which are the names that Blender and
  /// MeshLab look for; other vectors as name_x name_y name_z.
  void column(const Column& column, bool with_normal);

  /// Lines `property float x` ... of the header.
  std::string header() const;

  /// Appends the rows, little endian. Throws Error when a whole number does not fit 32 bits.
  void append_to(std::string& bytes) const;

 private:
  struct Part {
    std::vector<std::string> names;  ///< of its properties
    std::string column;
    std::variant<std::span<const float>, std::span<const std::int64_t>> values;
  };

  std::size_t rows_;
  std::vector<Part> parts_;
};

}  // namespace sessile
