#pragma once

#include <array>
#include <optional>

#include "draw/actors.h"
#include "draw/light_pass.h"

namespace sessile::draw {

/// What liquid is drawn over.
struct LiquidView {
  Lens lens{};
  Light light{};
  double spacing = 1;  ///< of the particles [m]
  std::optional<ClippingPlane> clip;
  const gl::Target* scene = nullptr;  ///< ScenePass's: what hides liquid, and is seen through it
  GLuint lit = 0;                     ///< the same, lit
};

/// Draws liquid in screen space (van der Laan et al. 2009): a depth of spheres or triangles, evened out, a thickness,
/// and from both a body that refracts, absorbs and mirrors.
class LiquidPass {
 public:
  LiquidPass();

  /// Liquid made of particles. Returns light of the picture's fine size, with what lies behind.
  GLuint draw(const LiquidView& view, const Spheres& spheres);

  /// Liquid inside a surface.
  GLuint draw(const LiquidView& view, const Skin& skin);

 private:
  void make_room(const LiquidView& view);
  void even_out(const LiquidView& view) const;
  GLuint compose(const LiquidView& view, bool has_normals) const;
  void start_layer(const gl::Target& target, bool adds) const;

  gl::Program sphere_depth_, sphere_thickness_, skin_depth_, skin_thickness_, smooth_, polish_, compose_;
  gl::VertexArray nothing_;

  struct Targets {
    gl::Target front;      // distance from the eye, and a normal where there is one
    gl::Target other;      // a distance, while it is evened out
    gl::Target thickness;  // in spacings
    gl::Target lit;
    Targets(int width, int height);
  };
  std::optional<Targets> targets_;
};

}  // namespace sessile::draw
