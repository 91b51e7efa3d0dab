#pragma once

#include <concepts>
#include <variant>

#include "sessile/forces/surface_feature.h"

namespace sessile {

/// What a member of Force offers: declared parameters, an acceleration, its reaction on the
/// solids, and the macroscopic tension that bounds dt.
template <class T>
concept ForceModel = Named<T> && requires(const T& model, const StepView& view, const Walls& walls, const Units& units,
                                          Array3& a, std::span<SolidForce> forces) {
  model.add_acceleration(view, a);
  model.add_reaction(view, walls, forces);
  { model.tension(units) } -> std::same_as<double>;
  { T::uses_normals } -> std::convertible_to<bool>;
};

static_assert(ForceModel<SurfaceFeature>);

/// Every force a scene can list under "forces".
using Force = std::variant<SurfaceFeature>;

}  // namespace sessile
