#include "view/canvas.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <utility>

#include "draw/legend.h"

namespace sessile::viewer {
namespace {

/// Puts back the context of ImGui that was current: legends have one of their own.
class KeepContext {
 public:
  KeepContext() = default;
  ~KeepContext() { ImGui::SetCurrentContext(context_); }
  KeepContext(const KeepContext&) = delete;
  KeepContext& operator=(const KeepContext&) = delete;

 private:
  ImGuiContext* context_ = ImGui::GetCurrentContext();
};

}  // namespace

void Canvas::set_stage(const draw::Stage& stage) {
  painter_ = std::make_unique<draw::Painter>(stage);
  painter_->show(moment_);
}

void Canvas::show(draw::Moment moment) {
  moment_ = std::move(moment);
  painter_->show(moment_);
}

bool Canvas::bounds(Vec3d& low, Vec3d& high) const {
  const std::vector<float>& points = moment_.points;
  if (points.size() < 3) return false;
  std::array<float, 3> least{points[0], points[1], points[2]}, greatest = least;
  for (std::size_t k = 0; k + 2 < points.size(); k += 3) {
    for (std::size_t c = 0; c < 3; ++c) {
      least[c] = std::min(least[c], points[k + c]);
      greatest[c] = std::max(greatest[c], points[k + c]);
    }
  }
  low = vec_cast<double>(Vec3<float>{least[0], least[1], least[2]});
  high = vec_cast<double>(Vec3<float>{greatest[0], greatest[1], greatest[2]});
  return true;
}

void Canvas::paint(const draw::Camera& camera, const draw::Appearance& appearance, int width, int height, bool coarse) {
  if (width != this->width() || height != this->height()) {
    const KeepContext keep;
    target_ = std::make_unique<draw::gl::Target>(width, height, std::initializer_list<GLenum>{GL_RGBA8}, true);
    coarse_ =
        std::make_unique<draw::gl::Target>((width + 1) / 2, (height + 1) / 2, std::initializer_list<GLenum>{GL_RGBA8});
    ink_ = std::make_unique<draw::Ink>(width, height);
  }
  if (coarse) {
    draw::Appearance rough = appearance;
    rough.fineness = 1;
    painter_->paint(camera, rough, coarse_->width(), coarse_->height(), coarse_->framebuffer());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, coarse_->framebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target_->framebuffer());
    glBlitFramebuffer(0, 0, coarse_->width(), coarse_->height(), 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  } else {
    painter_->paint(camera, appearance, width, height, target_->framebuffer());
  }
  if (!appearance.legend) return;
  const KeepContext keep;
  const auto range = appearance.range.value_or(draw::own_range(moment_));
  ink_->draw(target_->framebuffer(), [&] {
    draw::draw_legend(moment_, appearance, range, static_cast<float>(width), static_cast<float>(height));
  });
}

void Canvas::copy_to(const Region& region, int window_height) const {
  if (!target_) return;
  const int bottom = window_height - region.y - region.height;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target_->framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glDisable(GL_SCISSOR_TEST);
  glBlitFramebuffer(0, 0, width(), height(), region.x, bottom, region.x + region.width, bottom + region.height,
                    GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  draw::gl::check("copying the picture to the window");
}

draw::Image Canvas::image() const { return draw::read_pixels(width(), height(), target_->framebuffer()); }

}  // namespace sessile::viewer
