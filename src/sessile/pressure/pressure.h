#pragma once

#include <concepts>
#include <variant>

#include "sessile/core/fields.h"
#include "sessile/pressure/dfsph.h"
#include "sessile/pressure/iisph.h"
#include "sessile/pressure/pcisph.h"
#include "sessile/pressure/wcsph.h"

namespace sessile {

/// What a member of Pressure offers: declared parameters, a solve() of its own in solve.h, and, where it says so, a
/// remove_divergence() too.
template <class T>
concept PressureModel = Named<T> && requires {
  { T::frees_velocities_of_divergence } -> std::convertible_to<bool>;
};

static_assert(PressureModel<Iisph> && PressureModel<Pcisph> && PressureModel<Wcsph> && PressureModel<Dfsph>);

/// Every pressure solver a scene can name under "pressure".
using Pressure = std::variant<Iisph, Pcisph, Wcsph, Dfsph>;

/// Whether it turns until an average compression is reached. WCSPH does not: its speed of sound allows what it allows.
inline bool promises_density(const Pressure& method) {
  return std::visit(
      [](const auto& solver) {
        if constexpr (requires { solver.error; }) {
          return true;
        } else {
          return false;
        }
      },
      method);
}

}  // namespace sessile
