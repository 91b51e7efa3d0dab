#include "picture/studio.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "draw/gl.h"
#include "draw/headless.h"
#include "draw/ink.h"
#include "draw/legend.h"
#include "draw/painter.h"

namespace sessile::app {
namespace {

/// The share of particles at either end of an axis that a picture need not show.
constexpr double stray_share = 0.01;

/// Widens a box by a moment's particles, all but strays.
void include(const draw::Moment& moment, double margin, Vec3d& low, Vec3d& high) {
  const std::size_t n = moment.points.size() / 3;
  std::vector<float> along(n);
  const auto axis = [&](std::size_t which, double& least, double& greatest) {
    along.clear();
    for (std::size_t k = 0; k < n; ++k) {
      if (std::isfinite(moment.points[3 * k + which])) along.push_back(moment.points[3 * k + which]);
    }
    if (along.empty()) return;
    const auto place = static_cast<std::ptrdiff_t>(stray_share * static_cast<double>(along.size() - 1));
    std::nth_element(along.begin(), along.begin() + place, along.end());
    least = std::min(least, along[static_cast<std::size_t>(place)] - margin);
    std::nth_element(along.begin(), along.end() - 1 - place, along.end());
    greatest = std::max(greatest, *(along.end() - 1 - place) + margin);
  };
  axis(0, low.x, high.x);
  axis(1, low.y, high.y);
  axis(2, low.z, high.z);
}

}  // namespace

std::pair<float, float> common_range(std::span<const draw::Moment> moments) {
  std::optional<std::pair<float, float>> range;
  for (const draw::Moment& moment : moments) {
    const auto own = draw::own_range(moment);
    range = range ? std::pair{std::min(range->first, own.first), std::max(range->second, own.second)} : own;
  }
  return range.value_or(std::pair{0.0F, 1.0F});
}

struct Studio::Impl {
  explicit Impl(const PictureOptions& told)
      : options(told), target(told.size.first, told.size.second, {GL_RGBA8}), ink(told.size.first, told.size.second) {
    appearance.look = told.look;
    appearance.legend = !told.no_legend;
    appearance.solids = !told.no_solids;
    appearance.fineness = told.fineness;
  }

  const PictureOptions& options;
  draw::HeadlessContext context;  // before all that needs it
  draw::Appearance appearance;
  draw::gl::Target target;
  draw::Ink ink;
  std::optional<draw::gl::Target> panel;  // where there are several
  std::optional<draw::Painter> painter;
  draw::Camera camera;

  int width() const { return options.size.first; }
  int height() const { return options.size.second; }
};

Studio::Studio(const PictureOptions& options) : impl_(std::make_unique<Impl>(options)) {}

Studio::~Studio() = default;

void Studio::set_up(const draw::Stage& stage, std::span<const draw::Moment> moments, std::size_t panels) {
  impl_->painter.emplace(stage);
  const int width = impl_->width() / static_cast<int>(panels);
  if (panels > 1) impl_->panel.emplace(width, impl_->height(), std::initializer_list<GLenum>{GL_RGBA8});
  Vec3d low = stage.low, high = stage.high;
  for (const draw::Moment& moment : moments) include(moment, 0.5 * stage.spacing, low, high);
  draw::Camera& camera = impl_->camera;
  camera.up = stage.up;
  camera.orthographic = impl_->options.orthographic;
  std::tie(camera.azimuth, camera.elevation) = impl_->options.view;
  const bool bar = impl_->appearance.legend && impl_->appearance.look == draw::Look::particles;
  camera.fit(low, high, static_cast<double>(width) / impl_->height(), bar ? draw::legend_share() : 0);
  camera.zoom(impl_->options.zoom);
}

draw::Image Studio::draw(std::span<const draw::Moment> moments, std::pair<float, float> range) {
  Impl& d = *impl_;
  d.appearance.range = range;
  const int count = static_cast<int>(moments.size());
  int left = 0;
  for (int k = 0; k < count; ++k) {
    d.painter->show(moments[static_cast<std::size_t>(k)]);
    if (!d.panel) {
      d.painter->paint(d.camera, d.appearance, d.width(), d.height(), d.target.framebuffer());
      break;
    }
    // The last panel is wider by what does not divide.
    const int width = d.panel->width(), height = d.height(), right = k + 1 == count ? d.width() : left + width;
    d.painter->paint(d.camera, d.appearance, width, height, d.panel->framebuffer());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, d.panel->framebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, d.target.framebuffer());
    glBlitFramebuffer(0, 0, width, height, left, 0, right, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    left = right;
  }
  const auto width = static_cast<float>(d.width()), height = static_cast<float>(d.height());
  if (d.appearance.legend) {
    d.ink.draw(d.target.framebuffer(), [&] {
      for (int k = 0; k < count; ++k) {
        draw::draw_time(moments[static_cast<std::size_t>(k)], static_cast<float>(k) * width / static_cast<float>(count),
                        height);
      }
      draw::draw_color_bar(moments.front(), d.appearance, range, width, height);
    });
  }
  return draw::read_pixels(d.width(), d.height(), d.target.framebuffer());
}

}  // namespace sessile::app
