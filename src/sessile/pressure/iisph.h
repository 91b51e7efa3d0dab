#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "sessile/core/fields.h"

namespace sessile {

/// How the density that v* leads to is predicted: to first order as in (27), or at the positions it leads to.
enum class Prediction { linear, positions };

template <>
struct Words<Prediction> {
  static constexpr std::array<std::string_view, 2> words{"linear", "positions"};
};

/// How an iteration improves the pressures: by relaxed Jacobi steps (35), or along conjugate directions.
enum class Iteration { jacobi, conjugate };

template <>
struct Words<Iteration> {
  static constexpr std::array<std::string_view, 2> words{"jacobi", "conjugate"};
};

/// Implicit incompressible SPH (Ihmsen et al. 2014; the paper's eqs. 24-35 and Algorithm 1).
struct Iisph {
  double error = 1e-4;
  int min_iterations = 4;
  int max_iterations = 200;
  double relaxation = 0.5;
  double warm_start = 0.5;
  double momentum = 0.3;
  int long_solve = 50;
  Prediction prediction = Prediction::linear;
  Iteration iteration = Iteration::conjugate;
  double renewal = 0.03;

  static constexpr std::string_view name = "iisph";
  static constexpr std::string_view summary =
      "implicit incompressible SPH (eqs. 24-35), by conjugate directions or the paper's relaxed Jacobi steps";
  static constexpr bool frees_velocities_of_divergence = false;
  static constexpr auto fields() {
    using T = Iisph;
    return std::tuple{
        field(&T::error, "error", "", positive, "average compression over rest density at which a solve ends"),
        field(&T::min_iterations, "min_iterations", "", at_least(1), "fewest iterations of a solve"),
        field(&T::max_iterations, "max_iterations", "", at_least(1),
              "most iterations of a solve; a solve that ends here is counted and reported"),
        field(&T::iteration, "iteration",
              "what improves the pressures: relaxed steps as in (35), or conjugate directions, which take fewer"),
        field(&T::renewal, "renewal", "", between(0.001, 1),
              "conjugate: share of a solve's pressures in the mean that the next one starts from"),
        field(&T::relaxation, "relaxation", "", between(0.01, 1),
              "jacobi: omega, weight of the new pressure in an iteration"),
        field(&T::warm_start, "warm_start", "", between(0, 1),
              "jacobi: share of the last step's pressure a solve starts from"),
        field(&T::momentum, "momentum", "", between(0, 0.9),
              "jacobi: share of an iteration's change that the next one repeats; 0 gives (35) as printed"),
        field(&T::long_solve, "long_solve", "", at_least(1),
              "iterations above which a solve makes the next step shorter"),
        field(&T::prediction, "prediction",
              "advected density: linear in the step as in (27), or taken at the predicted positions, within 2 %"),
    };
  }
};

}  // namespace sessile
