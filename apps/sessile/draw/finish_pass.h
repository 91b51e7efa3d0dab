#pragma once

#include "draw/gl.h"

namespace sessile::draw {

/// Turns linear light into a picture: several pixels into one, edges softened when there is one for one.
class FinishPass {
 public:
  FinishPass();

  void draw(GLuint light, int fineness, int width, int height, GLuint framebuffer) const;

 private:
  gl::Program gather_, soften_;
  gl::VertexArray nothing_;
};

}  // namespace sessile::draw
