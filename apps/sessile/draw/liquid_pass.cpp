#include "draw/liquid_pass.h"

#include "draw/liquid_shaders.h"

namespace sessile::draw {
namespace {

// In particle spacings: large enough that films have no holes, that thickness varies little from particle to particle,
// and that single particles cannot be told apart.
constexpr double front_radius = 0.85;
constexpr double thickness_radius = 1.00;
constexpr double rim_thickness = 0.30;
constexpr double smooth_reach = 2.2;
constexpr double polish_reach = 0.7;
constexpr double narrow_range = 1.2;
constexpr int smooth_rounds = 2;

}  // namespace

namespace shaders = liquid_shaders;

LiquidPass::Targets::Targets(int width, int height)
    : front(width, height, {GL_R32F, GL_RGB10_A2}, true),
      other(width, height, {GL_R32F}),
      thickness((width + 1) / 2, (height + 1) / 2, {GL_R32F}),
      lit(width, height, {GL_RGBA16F}) {
  gl::filter_smoothly(lit.color());
  gl::filter_smoothly(thickness.color());
}

LiquidPass::LiquidPass()
    : sphere_depth_("depth of liquid", {glsl_lens, glsl_clip}, glsl_spheres, shaders::sphere_depth),
      sphere_thickness_("thickness of liquid", {glsl_lens, glsl_clip}, glsl_spheres, shaders::sphere_thickness),
      skin_depth_("depth of a surface", {glsl_lens, glsl_clip}, shaders::skin_vertex, shaders::skin_depth),
      skin_thickness_("thickness within a surface", {glsl_lens, glsl_clip}, shaders::skin_vertex,
                      shaders::skin_thickness),
      smooth_("evening out liquid", {glsl_lens}, glsl_whole_picture, shaders::smooth),
      polish_("polishing liquid", {glsl_lens}, glsl_whole_picture, shaders::polish),
      compose_("liquid", {glsl_lens, glsl_surroundings}, glsl_whole_picture, shaders::compose) {}

void LiquidPass::make_room(const LiquidView& view) {
  const int width = view.scene->width(), height = view.scene->height();
  if (targets_ && targets_->front.width() == width && targets_->front.height() == height) return;
  targets_.reset();
  targets_.emplace(width, height);
}

void LiquidPass::start_layer(const gl::Target& target, bool adds) const {
  target.draw_here();
  glClearColor(0, 0, 0, 0);
  if (adds) {
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glDisable(GL_DEPTH_TEST);
  } else {
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
  }
}

GLuint LiquidPass::draw(const LiquidView& view, const Spheres& spheres) {
  if (spheres.count() == 0) return view.lit;
  make_room(view);
  glBindVertexArray(nothing_.name());
  const auto draw_layer = [&](const gl::Target& target, const gl::Program& program, double radius, bool adds) {
    start_layer(target, adds);
    program.use();
    view.lens.set(program);
    set_clip(program, view.clip);
    program.set("picture", static_cast<float>(target.width()), static_cast<float>(target.height()));
    program.set("spacing", view.spacing);
    program.bind("scene_depth", 0, view.scene->depth());
    spheres.draw(program, radius * view.spacing, 2 * view.lens.slope_y / target.height());
  };
  draw_layer(targets_->front, sphere_depth_, front_radius, false);
  draw_layer(targets_->thickness, sphere_thickness_, thickness_radius, true);
  even_out(view);
  return compose(view, false);
}

GLuint LiquidPass::draw(const LiquidView& view, const Skin& skin) {
  if (skin.count() == 0) return view.lit;
  make_room(view);
  const auto draw_layer = [&](const gl::Target& target, const gl::Program& program, bool adds) {
    start_layer(target, adds);
    program.use();
    view.lens.set(program);
    set_clip(program, view.clip);
    program.set("picture", static_cast<float>(target.width()), static_cast<float>(target.height()));
    program.set("spacing", view.spacing);
    program.bind("scene_depth", 0, view.scene->depth());
    skin.draw();
  };
  draw_layer(targets_->front, skin_depth_, false);
  draw_layer(targets_->thickness, skin_thickness_, true);
  return compose(view, true);
}

void LiquidPass::even_out(const LiquidView& view) const {
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(nothing_.name());
  smooth_.use();
  view.lens.set(smooth_);
  smooth_.bind("scene_depth", 1, view.scene->depth());
  smooth_.set("narrow", narrow_range * view.spacing);
  double reach = smooth_reach * view.spacing;
  for (int round = 0; round < smooth_rounds; ++round, reach *= 0.5) {
    smooth_.set("reach", reach);
    targets_->other.draw_here();
    smooth_.bind("front", 0, targets_->front.color());
    smooth_.set("axis", 1.0F, 0.0F);
    draw_whole_picture();
    targets_->front.draw_here();
    smooth_.bind("front", 0, targets_->other.color());
    smooth_.set("axis", 0.0F, 1.0F);
    draw_whole_picture();
  }
  polish_.use();
  view.lens.set(polish_);
  polish_.bind("front", 0, targets_->front.color());
  polish_.set("narrow", narrow_range * view.spacing);
  polish_.set("reach", polish_reach * view.spacing);
  targets_->other.draw_here();
  draw_whole_picture();
}

GLuint LiquidPass::compose(const LiquidView& view, bool has_normals) const {
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(nothing_.name());
  targets_->lit.draw_here();
  compose_.use();
  view.lens.set(compose_);
  view.light.set(compose_, view.lens);
  compose_.bind("front", 0, has_normals ? targets_->front.color(0) : targets_->other.color());
  compose_.bind("normals", 1, targets_->front.color(1));
  compose_.bind("thickness_map", 2, targets_->thickness.color());
  compose_.bind("scene_depth", 3, view.scene->depth());
  compose_.bind("lit_map", 4, view.lit);
  compose_.set("has_normals", has_normals);
  compose_.set("spacing", view.spacing);
  compose_.set("rim", rim_thickness);
  draw_whole_picture();
  return targets_->lit.color();
}

}  // namespace sessile::draw
