#pragma once

#include <memory>

#include "draw/camera.h"
#include "draw/moment.h"

namespace sessile::draw {

/// Draws moments with OpenGL 3.3 core, into whatever framebuffer it is told. Needs a current context for all it does,
/// the destructor among it.
class Painter {
 public:
  /// Compiles the shaders. Throws Error with the compiler's words when the driver cannot take them.
  explicit Painter(const Stage& stage);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// Hands particles, colours and surface to the graphics card.
  void show(const Moment& moment);

  /// Paints the last moment shown over the whole framebuffer, width x height pixels. The legend is not among it: see
  /// draw/legend.h. Throws Error when OpenGL reports one.
  void paint(const Camera& camera, const Appearance& appearance, int width, int height, unsigned framebuffer = 0);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Ends of the colours that a moment has by itself: of a speed from 0; never of no length.
std::pair<float, float> own_range(const Moment& moment);

}  // namespace sessile::draw
