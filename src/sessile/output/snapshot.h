#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sessile/core/array.h"

namespace sessile {

class Simulation;
struct Walls;

/// The numbers of a column.
using ColumnValues = std::variant<std::vector<float>, std::vector<std::int64_t>>;

/// One quantity of every particle: `components` numbers each, particle by particle.
struct Column {
  std::string name;
  std::string unit;  ///< SI; "" for a pure number
  int components = 1;
  ColumnValues values;
};

/// A copy of what one frame holds, so that it can be written while the simulation goes on.
struct Snapshot {
  double time = 0;  ///< [s]
  std::int64_t step = 0;
  std::vector<float> points;  ///< x y z of each particle [m]
  std::vector<Column> columns;

  std::size_t size() const { return points.size() / 3; }
};

/// A per-particle field that a frame can hold, for lists and messages.
struct KnownColumn {
  std::string_view name;
  std::string_view unit;  ///< SI; "" for a pure number
  int components;
  std::string_view help;
};

/// Start of the names of fields that hold one force's acceleration, such as acceleration_gravity.
inline constexpr std::string_view acceleration_prefix = "acceleration_";

/// All fields in order; the last one, "acceleration_<force>", stands for one per force, "gravity", "viscosity" and
/// "pressure" among them.
std::vector<KnownColumn> known_columns();

/// A field that is no acceleration, in SI units; nothing when there is none of that name.
std::optional<Column> plain_column(const Simulation& simulation, std::string_view name);

/// The vectors as x y z, x y z ...
std::vector<float> interleaved(const Array3& from);

/// Copies positions and the named fields, in SI units. Throws Error when there is no field of a name.
Snapshot take_snapshot(const Simulation& simulation, std::span<const std::string> columns);

/// Copies the samples of all solids with the index of their solid.
Snapshot take_solids(const Walls& walls);

}  // namespace sessile
