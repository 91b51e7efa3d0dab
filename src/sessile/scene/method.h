#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "sessile/core/fields.h"
#include "sessile/forces/force.h"
#include "sessile/pressure/pressure.h"
#include "sessile/scene/read.h"

namespace sessile {

/// How a liquid is computed, apart from what it is and does: a pressure solver and forces. Any scene can be run by it.
struct Method {
  std::string title;
  Pressure pressure = Iisph{};
  std::vector<Force> forces;

  static constexpr auto fields() {
    using T = Method;
    return std::tuple{
        field(&T::title, "title", "one line for people"),
        required(field(&T::pressure, "pressure", "the pressure solver")),
        field(&T::forces, "forces", "tension and adhesion; without one the liquid has none"),
    };
  }
};

/// A method, and where its file says what.
struct ResolvedMethod {
  Method method;
  std::map<std::string, std::string> places;  ///< by path: "paper.json:3"
};

/// Reads a method's file as scenes are read. Throws SceneError with every fault of the file.
ResolvedMethod read_resolved_method(const std::filesystem::path& file);

/// The method alone.
Method read_method(const std::filesystem::path& file);

/// The scene with the method's solver and forces in place of its own.
/// Throws SceneError with every fault of what the two make together.
ResolvedScene with_method(const ResolvedScene& scene, const ResolvedMethod& method, const FurtherCheck& further = {});

}  // namespace sessile
