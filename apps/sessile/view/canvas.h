#pragma once

#include <memory>

#include "draw/camera.h"
#include "draw/gl.h"
#include "draw/image.h"
#include "draw/ink.h"
#include "draw/moment.h"
#include "draw/painter.h"
#include "view/window.h"

namespace sessile::viewer {

/// The picture without the panels around it: painted when something in it has changed, copied to the window otherwise.
class Canvas {
 public:
  explicit Canvas(const draw::Stage& stage) : painter_(std::make_unique<draw::Painter>(stage)) {}

  void set_stage(const draw::Stage& stage);
  void show(draw::Moment moment);
  const draw::Moment& moment() const { return moment_; }

  /// Box around the particles shown; false when there are none.
  bool bounds(Vec3d& low, Vec3d& high) const;

  /// `coarse`: with a quarter of the pixels, drawn larger, where a whole picture takes long.
  void paint(const draw::Camera& camera, const draw::Appearance& appearance, int width, int height, bool coarse);
  void copy_to(const Region& region, int window_height) const;
  draw::Image image() const;

  int width() const { return target_ ? target_->width() : 0; }
  int height() const { return target_ ? target_->height() : 0; }

 private:
  std::unique_ptr<draw::Painter> painter_;
  std::unique_ptr<draw::gl::Target> target_, coarse_;
  std::unique_ptr<draw::Ink> ink_;
  draw::Moment moment_;
};

}  // namespace sessile::viewer
