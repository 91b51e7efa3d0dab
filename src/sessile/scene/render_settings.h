#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "sessile/core/fields.h"
#include "sessile/core/vec.h"

/// What `sessile render` makes of a scene's surfaces: looks, light and camera.
namespace sessile {

enum class LiquidLook { water, clear, oil, honey, wine, milk, paint, metal };

template <>
struct Words<LiquidLook> {
  static constexpr std::array<std::string_view, 8> words{"water", "clear", "oil",   "honey",
                                                         "wine",  "milk",  "paint", "metal"};
};

enum class SolidFinish { matte, glossy, metal };

template <>
struct Words<SolidFinish> {
  static constexpr std::array<std::string_view, 3> words{"matte", "glossy", "metal"};
};

enum class Backdrop { studio, white, dark };

template <>
struct Words<Backdrop> {
  static constexpr std::array<std::string_view, 3> words{"studio", "white", "dark"};
};

/// Where a rendered picture is taken from: by a place, or by a direction and what is to be in the picture.
struct RenderCamera {
  std::optional<Vec3d> position;
  std::optional<Vec3d> target;
  double azimuth = 30;
  double elevation = 25;
  double zoom = 1;
  double field_of_view = 35;
  double aperture = 0;

  static constexpr auto fields() {
    using T = RenderCamera;
    return std::tuple{
        derived(field(&T::position, "position", "m", any_number, "where the camera stands"),
                "so far off, in the direction below, that all is in the picture"),
        derived(field(&T::target, "target", "m", any_number, "what stands in the middle"),
                "the middle of the solids and of the liquid near them, over the whole film"),
        field(&T::azimuth, "azimuth", "deg", any_number, "direction to the camera, about the vertical"),
        field(&T::elevation, "elevation", "deg", between(-90, 90), "direction to the camera, above the horizontal"),
        field(&T::zoom, "zoom", "", positive, "how much nearer than where all is in the picture"),
        field(&T::field_of_view, "field_of_view", "deg", between(1, 120), "vertical angle of the picture"),
        field(&T::aperture, "aperture", "", between(0, 0.5),
              "lens over the distance to the target: blurs what is nearer or farther; 0 for sharp"),
    };
  }
};

/// What one solid looks like.
struct RenderSolid {
  std::string label;
  SolidFinish finish = SolidFinish::matte;
  std::optional<Vec3d> color;
  bool visible = true;

  static constexpr auto fields() {
    using T = RenderSolid;
    return std::tuple{
        required(field(&T::label, "label", "the solid's label; solid0, solid1 ... where it has none")),
        field(&T::finish, "finish", "of its faces"),
        derived(field(&T::color, "color", "", between(0, 1), "red, green, blue; linear"), "a calm one"),
        field(&T::visible, "visible", "whether it is shown"),
    };
  }
};

/// A rendered film in full.
struct RenderSettings {
  LiquidLook look = LiquidLook::water;
  std::optional<Vec3d> color;
  Backdrop background = Backdrop::studio;
  RenderCamera camera{};
  std::vector<RenderSolid> solids;
  int width = 1280;
  int height = 720;
  int samples = 64;
  double shutter = 0.5;
  double margin = 0.5;

  static constexpr auto fields() {
    using T = RenderSettings;
    return std::tuple{
        field(&T::look, "look", "of the liquid"),
        derived(field(&T::color, "color", "", between(0, 1),
                      "red, green, blue of the liquid, linear: what some depth of it leaves of white light"),
                "the look's"),
        field(&T::background, "background", "what stands behind, and the light"),
        field(&T::camera, "camera", "where the picture is taken from"),
        field(&T::solids, "solids", "what solids look like"),
        field(&T::width, "width", "", between(16, 16384), "pixels"),
        field(&T::height, "height", "", between(16, 16384), "pixels"),
        field(&T::samples, "samples", "", between(1, 65536), "rays for each pixel: four times as many halve the noise"),
        field(&T::shutter, "shutter", "", between(0, 1),
              "share of the time between frames, or of 1/24 s where that is less, that a picture takes"),
        field(&T::margin, "margin", "", between(0, 2),
              "how far the faces of solids stand out from their samples, over the spacing: liquid keeps off them"),
    };
  }
};

}  // namespace sessile
