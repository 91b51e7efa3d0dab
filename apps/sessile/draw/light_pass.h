#pragma once

#include "draw/lens.h"

namespace sessile::draw {

/// What lights a scene.
struct Light {
  Lens lens{};         ///< the light's own, and of its shadow map
  GLuint shadows = 0;  ///< depths as the light sees them
  Vec3d up{0, 0, 1};
  double spacing = 1;  ///< of the particles: the scale of what touches [m]
  Vec3d shadow{};      ///< what comes through what casts shadows, of red, green and blue light, 0 to 1

  /// Says to a program with glsl_surroundings where the lamp and the zenith are.
  void set(const gl::Program& program, const Lens& seen_by) const;
};

/// Lights what ScenePass has drawn: a sky all around, less where things are close to each other, and a lamp with
/// shadows that soften with distance. The result is linear light over a calm background.
class LightPass {
 public:
  LightPass();

  /// `rough` targets (two, of two components) may be smaller than the scene's; `lit` has its size.
  void draw(const gl::Target& scene, const gl::Target& rough, const gl::Target& other_rough, const gl::Target& lit,
            const Lens& lens, const Light& light) const;

 private:
  gl::Program look_around_, blur_, shade_;
  gl::VertexArray nothing_;
};

/// Colours of the surroundings in linear light, for whatever mirrors them; `lamp` and `above` are directions as seen
/// from the eye.
extern const std::string_view glsl_surroundings;

}  // namespace sessile::draw
