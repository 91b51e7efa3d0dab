#pragma once

#include <concepts>
#include <variant>

#include "sessile/forces/akinci2013.h"
#include "sessile/forces/becker2007.h"
#include "sessile/forces/csf.h"
#include "sessile/forces/he2014.h"
#include "sessile/forces/surface_feature.h"
#include "sessile/forces/tartakovsky2005.h"

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
static_assert(ForceModel<Akinci2013>);
static_assert(ForceModel<Csf>);
static_assert(ForceModel<Becker2007>);
static_assert(ForceModel<Tartakovsky2005>);
static_assert(ForceModel<He2014>);

/// Every force a scene can list under "forces".
using Force = std::variant<SurfaceFeature, Akinci2013, Csf, Becker2007, Tartakovsky2005, He2014>;

}  // namespace sessile
