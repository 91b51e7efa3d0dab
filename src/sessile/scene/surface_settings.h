#pragma once

#include <string_view>
#include <tuple>
#include <variant>

#include "sessile/core/fields.h"

/// How a surface is put around particles. Lengths are in particle radii, half the particle spacing.
namespace sessile {

/// Level set of the SPH density.
struct DensityField {
  double smoothing_length = 2;
  double threshold = 0.6;

  static constexpr std::string_view name = "density";
  static constexpr std::string_view summary = "level set of the SPH density";
  static constexpr auto fields() {
    using T = DensityField;
    return std::tuple{
        field(&T::smoothing_length, "smoothing_length", "", positive,
              "smoothing length over the particle radius; the kernel reaches twice as far"),
        field(&T::threshold, "threshold", "", positive, "density at the surface over the rest density"),
    };
  }
};

using SurfaceMethod = std::variant<DensityField>;

/// A surface in full.
struct SurfaceSettings {
  SurfaceMethod method = DensityField{};
  double cube_size = 0.75;

  static constexpr auto fields() {
    using T = SurfaceSettings;
    return std::tuple{
        field(&T::method, "method", "the field whose level set is the surface"),
        field(&T::cube_size, "cube_size", "", positive, "edge of a cell of the grid over the particle radius"),
    };
  }
};

}  // namespace sessile
