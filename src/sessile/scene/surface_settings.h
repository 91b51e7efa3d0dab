#pragma once

#include <string_view>
#include <tuple>
#include <variant>

#include "sessile/core/fields.h"

/// How a surface is put around particles. Lengths are in particle radii, half the particle spacing.
namespace sessile {

/// Level set of a density of ellipsoids, one for each particle, fitted to its neighbours: flat in films, long in
/// strands. After Yu and Turk, Reconstructing surfaces of particle-based fluids using anisotropic kernels, 2013.
struct AnisotropicKernels {
  double smoothing_length = 2;
  double threshold = 0.4;
  double flattest = 0.7;
  double evening = 0.5;

  static constexpr std::string_view name = "anisotropic";
  static constexpr std::string_view summary =
      "level set of the density of ellipsoids fitted to each particle's neighbours";
  static constexpr auto fields() {
    using T = AnisotropicKernels;
    return std::tuple{
        field(&T::smoothing_length, "smoothing_length", "", positive,
              "smoothing length over the particle radius; the kernel reaches twice as far"),
        field(&T::threshold, "threshold", "", between(0.01, 0.99),
              "level of the surface; 1 is the inside of the liquid"),
        field(&T::flattest, "flattest", "", between(0.1, 1), "least axis of an ellipsoid over its greatest"),
        field(&T::evening, "evening", "", between(0, 1),
              "how far a particle is moved to where its neighbours would have it, as a share"),
    };
  }
};

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
        field(&T::threshold, "threshold", "", positive, "density at the surface over a particle's own"),
    };
  }
};

/// Distance to the mean of the particles near by, after Zhu and Bridson, Animating sand as a fluid, 2005.
struct MeanDistance {
  double smoothing_length = 2;
  double radius = 1;

  static constexpr std::string_view name = "zhu_bridson";
  static constexpr std::string_view summary = "distance to the weighted mean of the particles near by";
  static constexpr auto fields() {
    using T = MeanDistance;
    return std::tuple{
        field(&T::smoothing_length, "smoothing_length", "", positive,
              "half of the reach of the weights over the particle radius"),
        field(&T::radius, "radius", "", between(0.1, 4),
              "distance of the surface from the mean over the particle radius"),
    };
  }
};

using SurfaceMethod = std::variant<DensityField, AnisotropicKernels, MeanDistance>;

/// A surface in full.
struct SurfaceSettings {
  SurfaceMethod method = DensityField{};
  double cube_size = 0.75;
  int smoothing = 10;
  int normal_smoothing = 2;
  double decimation = 0;
  double decimation_error = 0.1;

  static constexpr auto fields() {
    using T = SurfaceSettings;
    return std::tuple{
        field(&T::method, "method", "the field whose level set is the surface"),
        field(&T::cube_size, "cube_size", "", positive, "edge of a cell of the grid over the particle radius"),
        field(&T::smoothing, "smoothing", "", between(0, 1000),
              "turns of smoothing that leave the volume: each moves vertices to the mean of their neighbours and back"),
        field(&T::normal_smoothing, "normal_smoothing", "", between(0, 1000),
              "turns of smoothing of the normals alone"),
        field(&T::decimation, "decimation", "", between(0, 0.99),
              "share of the triangles to take out (0: none; 0.9 leaves a tenth)"),
        field(&T::decimation_error, "decimation_error", "", positive,
              "how far the surface may move by that over the particle radius; fewer triangles go where it would be "
              "farther"),
    };
  }
};

}  // namespace sessile
