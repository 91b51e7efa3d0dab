#include "draw/painter.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "draw/finish_pass.h"
#include "draw/light_pass.h"
#include "draw/liquid_pass.h"
#include "draw/scene_pass.h"
#include "sessile/core/error.h"

namespace sessile::draw {
namespace {

constexpr int shadow_pixels = 1024;  // along an axis, times the fineness, and no more than four times
constexpr double ground_reach = 5;   // over the stage's own

struct Box {
  Vec3d low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  void add(const Vec3d& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  bool empty() const { return !(low.x <= high.x); }
  Vec3d centre() const { return 0.5 * (low + high); }
  double reach() const { return 0.5 * length(high - low); }
};

Box box_of(const Stage& stage) {
  Box box;
  for (const Vec3d& p : {stage.low, stage.high}) box.add(p);
  for (const SolidMesh& solid : stage.solids) {
    for (const Vec3d& p : solid.mesh.vertices) box.add(p);
  }
  return box;
}

/// The height of something under all of the stage, along up; nothing when a solid lies there already.
std::optional<double> ground_below(const Stage& stage, const Box& box) {
  if (stage.weightless || box.empty()) return {};
  const auto height = [&](const Vec3d& p) { return dot(p, stage.up); };
  double lowest = 1e300;
  for (int corner = 0; corner < 8; ++corner) {
    lowest =
        std::min(lowest, height({(corner & 1) != 0 ? box.high.x : box.low.x, (corner & 2) != 0 ? box.high.y : box.low.y,
                                 (corner & 4) != 0 ? box.high.z : box.low.z}));
  }
  for (const SolidMesh& solid : stage.solids) {
    Box own;
    double bottom = 1e300;
    for (const Vec3d& p : solid.mesh.vertices) {
      own.add(p);
      bottom = std::min(bottom, height(p));
    }
    // Its box without the heights must be nearly as wide as everything.
    const auto flat = [&](const Vec3d& size) { return length(size - dot(size, stage.up) * stage.up); };
    if (bottom <= lowest + 0.5 * stage.spacing && flat(own.high - own.low) >= 0.9 * flat(box.high - box.low)) return {};
  }
  return lowest;
}

/// The box of the moment's particles that have finite places; strays far out are not worth a coarser shadow.
Box box_of(const Moment& moment, const Box& stage) {
  Box box = stage;
  const double far = 4 * stage.reach();
  const Vec3d centre = stage.centre();
  for (std::size_t k = 0; k + 2 < moment.points.size(); k += 3) {
    const Vec3d p{moment.points[k], moment.points[k + 1], moment.points[k + 2]};
    if (length(p - centre) <= far) box.add(p);
  }
  return box;
}

}  // namespace

struct Painter::Impl {
  explicit Impl(const Stage& shown)
      : stage(shown),
        stage_box(box_of(shown)),
        moment_box(stage_box),
        ground(ground_below(shown, stage_box)),
        solids(shown) {}

  Stage stage;
  Box stage_box, moment_box;
  std::optional<double> ground;
  std::pair<float, float> range{0, 1};
  Spheres spheres;
  Solids solids;
  Skin skin;
  ScenePass scene_pass;
  LightPass light_pass;
  LiquidPass liquid_pass;
  FinishPass finish_pass;

  /// What depends on the picture's size, in fine pixels; what is smooth has half as many along each axis.
  struct Targets {
    gl::Target shadow_map, scene, rough, other_rough, lit;
    Targets(int width, int height, int fineness)
        : shadow_map(shadow_pixels * std::min(fineness, 4), shadow_pixels * std::min(fineness, 4), {}, true),
          scene(width, height, {GL_RGBA8, GL_RGB10_A2}, true),
          rough((width + 1) / 2, (height + 1) / 2, {GL_RG8}),
          other_rough((width + 1) / 2, (height + 1) / 2, {GL_RG8}),
          lit(width, height, {GL_RGBA16F}) {
      gl::filter_smoothly(lit.color());
    }
  };
  std::optional<Targets> targets;

  void make_room(int width, int height, int fineness) {
    if (targets && targets->scene.width() == width && targets->scene.height() == height) return;
    targets.reset();
    targets.emplace(width, height, fineness);
  }

  bool liquid(const Appearance& appearance) const { return appearance.look != Look::particles; }

  SceneView view_of(const Lens& lens, const Appearance& appearance) const {
    SceneView view;
    view.lens = lens;
    view.radius = 0.5 * stage.spacing;
    view.spheres = appearance.look == Look::particles;
    view.solids = appearance.solids;
    view.ground = appearance.ground && ground.has_value();
    view.ground_height = ground.value_or(0);
    view.up = stage.up;
    view.centre = stage_box.centre();
    view.reach = ground_reach * stage_box.reach();
    view.range = appearance.range.value_or(range);
    view.clip = appearance.clip;
    return view;
  }

  /// The lamp stands high, to the right of whoever looks, so that the picture is lit well from everywhere.
  Light light_for(const Camera& camera) const {
    const Vec3d flat = -camera.forward() + dot(camera.forward(), stage.up) * stage.up;
    const double size = length(flat);
    const Vec3d towards_eye = size > 1e-3 ? 1 / size * flat : Vec3d{};
    Light light;
    light.lens = lens_of_light(stage.up + 0.55 * camera.right() + 0.10 * towards_eye, moment_box.centre(),
                               moment_box.reach() + stage.spacing);
    light.shadows = targets->shadow_map.depth();
    light.up = stage.up;
    light.spacing = stage.spacing;
    return light;
  }

  void cast_shadows(const Light& light, const Appearance& appearance) const {
    SceneView view = view_of(light.lens, appearance);
    view.ground = false;
    if (liquid(appearance)) view.radius = 0.8 * stage.spacing;  // no light between particles
    view.spheres = appearance.look != Look::surface;
    view.skin = appearance.look == Look::surface;
    scene_pass.draw(targets->shadow_map, view, spheres, solids, skin);
  }

  void paint(const Camera& camera, const Appearance& appearance, int width, int height, unsigned framebuffer) {
    const int fineness = std::max(1, appearance.fineness);
    make_room(width * fineness, height * fineness, fineness);
    const double aspect = static_cast<double>(width) / height;
    const double reach =
        std::max(moment_box.reach(), view_of({}, appearance).ground ? ground_reach * stage_box.reach() : 0);
    const Lens lens = lens_of(camera, aspect, length(moment_box.centre() - camera.target) + reach + stage.spacing);
    Light light = light_for(camera);
    if (liquid(appearance)) light.shadow = {0.42, 0.60, 0.68};  // what is clear lets light through
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_STENCIL_TEST);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    cast_shadows(light, appearance);
    scene_pass.draw(targets->scene, view_of(lens, appearance), spheres, solids, skin);
    light_pass.draw(targets->scene, targets->rough, targets->other_rough, targets->lit, lens, light);
    GLuint light_map = targets->lit.color();
    if (liquid(appearance)) light_map = add_liquid(lens, light, appearance);
    finish_pass.draw(light_map, fineness, width, height, framebuffer);
  }

  GLuint add_liquid(const Lens& lens, const Light& light, const Appearance& appearance) {
    LiquidView view;
    view.lens = lens;
    view.light = light;
    view.spacing = stage.spacing;
    view.clip = appearance.clip;
    view.scene = &targets->scene;
    view.lit = targets->lit.color();
    return appearance.look == Look::surface ? liquid_pass.draw(view, skin) : liquid_pass.draw(view, spheres);
  }
};

Painter::Painter(const Stage& stage) : impl_(std::make_unique<Impl>(stage)) { gl::check("getting ready to draw"); }

Painter::~Painter() = default;

void Painter::show(const Moment& moment) {
  impl_->spheres.show(moment);
  impl_->range = own_range(moment);
  impl_->moment_box = box_of(moment, impl_->stage_box);
  if (moment.surface) {
    impl_->skin.show(*moment.surface);
  } else {
    impl_->skin.hide();
  }
  gl::check("handing particles to the graphics card");
}

void Painter::paint(const Camera& camera, const Appearance& appearance, int width, int height, unsigned framebuffer) {
  if (width < 1 || height < 1) return;  // a window that has been made small
  impl_->paint(camera, appearance, width, height, framebuffer);
  gl::check("painting");
}

std::pair<float, float> own_range(const Moment& moment) {
  float least = 0, greatest = 0;
  bool any = false;
  for (const float value : moment.values) {
    if (!std::isfinite(value)) continue;
    least = any ? std::min(least, value) : value;
    greatest = any ? std::max(greatest, value) : value;
    any = true;
  }
  // A magnitude is best seen beside nothing.
  if (moment.field == "speed" || (least > 0 && least < 0.5F * greatest)) least = 0;
  if (!(greatest > least)) {  // all the same: in the middle, or at the lower end when it is zero
    const float size = std::max(std::abs(least), std::abs(greatest));
    if (size == 0 || !std::isfinite(2 * size)) return {0.0F, 1.0F};
    return least == 0 ? std::pair{0.0F, 1.0F} : std::pair{least - 0.5F * size, greatest + 0.5F * size};
  }
  return {least, greatest};
}

}  // namespace sessile::draw
