#pragma once

#include <utility>

#include "draw/gl.h"
#include "draw/lens.h"
#include "draw/moment.h"

namespace sessile::draw {

/// A clipping plane as shaders know it; without one nothing is left out.
void set_clip(const gl::Program& program, const std::optional<ClippingPlane>& clip);

inline constexpr std::string_view glsl_clip = R"(
uniform vec4 clip;  // normal and offset
uniform bool is_clipped;
bool left_out(vec3 world) { return is_clipped && dot(clip.xyz, world) > clip.w; }
)";

/// The particles of a moment on the graphics card, four numbers each: place and value.
class Spheres {
 public:
  Spheres();

  void show(const Moment& moment);
  int count() const { return count_; }

  /// Binds them and draws one triangle around each sphere with the program in use, whose vertex shader holds
  /// glsl_spheres.
  void draw(const gl::Program& program, double radius, double pixel) const;

 private:
  gl::Buffer numbers_;
  gl::Texture texture_;
  int count_ = 0;
};

/// Vertex shader of spheres: hands on the centre as seen from the eye. A sphere smaller than a pixel is drawn as large
/// as one. Needs glsl_lens and glsl_clip.
extern const std::string_view glsl_spheres;

/// The solids of a stage on the graphics card.
class Solids {
 public:
  explicit Solids(const Stage& stage);

  /// Draws them with the program in use, whose vertex shader reads place (0) and normal (1).
  void draw() const;

 private:
  gl::Buffer corners_;
  gl::VertexArray array_;
  int two_sided_ = 0;  // corners of solids seen from both sides; those of containers follow
  int inward_ = 0;
};

/// A surface on the graphics card.
class Skin {
 public:
  Skin();

  void show(const SurfaceMesh& mesh);
  void hide() { count_ = 0; }
  int count() const { return count_; }

  /// Draws it with the program in use, whose vertex shader reads place (0) and normal (1).
  void draw() const;

 private:
  gl::Buffer places_, normals_, triangles_;
  gl::VertexArray array_;
  int count_ = 0;
};

}  // namespace sessile::draw
