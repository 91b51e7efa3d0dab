#pragma once

#include "draw/actors.h"

namespace sessile::draw {

/// What a pass over the scene has to draw, and how.
struct SceneView {
  Lens lens{};
  double radius = 0;  ///< of spheres [m]
  bool spheres = true;
  bool skin = false;  ///< a surface, as something opaque: for its shadow
  bool solids = true;
  bool ground = true;
  double ground_height = 0;  ///< along `up` [m]
  Vec3d up{0, 0, 1};
  Vec3d centre{};                       ///< of the stage [m]
  double reach = 1;                     ///< of the stage from there [m]
  std::pair<float, float> range{0, 1};  ///< ends of the colours
  std::optional<ClippingPlane> clip;
};

/// Draws what is not transparent: colour, facing and depth of each pixel, which later passes light. Facing is the
/// normal as seen from the eye, and in its last component what there is: 0 nothing, 1 a solid, 2 a particle, 3 the
/// ground, of 3.
class ScenePass {
 public:
  ScenePass();

  /// Into a target of two colours and a depth; or of a depth alone, as a shadow map wants it.
  void draw(const gl::Target& target, const SceneView& view, const Spheres& spheres, const Solids& solids,
            const Skin& skin) const;

 private:
  gl::Program spheres_, solids_, ground_;
  gl::VertexArray nothing_;
  gl::Texture colors_;
};

}  // namespace sessile::draw
