#pragma once

#include <string_view>

/// The shaders of LiquidPass.
namespace sessile::draw::liquid_shaders {

extern const std::string_view sphere_depth, sphere_thickness;           // fragments, after glsl_spheres
extern const std::string_view skin_vertex, skin_depth, skin_thickness;  // of a surface
extern const std::string_view smooth;                                   // evens out depth along one axis
extern const std::string_view polish;                                   // and at last in all directions
extern const std::string_view compose;                                  // what all of it looks like

}  // namespace sessile::draw::liquid_shaders
