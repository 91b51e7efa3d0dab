#include "draw/scene_pass.h"

#include <cmath>
#include <cstdint>

#include "draw/color_map.h"

namespace sessile::draw {
namespace {

constexpr std::string_view sphere_fragment = R"(
flat in vec3 centre;
flat in float extent;
flat in float value;
uniform vec2 picture;
uniform vec2 range;
uniform sampler2D colors;
layout(location = 0) out vec4 color;
layout(location = 1) out vec4 facing;
void main() {
  vec2 place = gl_FragCoord.xy / picture;
  vec3 direction = ray_direction(place), start = ray_start(place);
  float closest = dot(direction, centre - start);
  vec3 off = centre - start - closest * direction;
  float left = extent * extent - dot(off, off);
  if (left < 0.0) discard;
  float dip = sqrt(left);
  gl_FragDepth = depth_at((start + (closest - dip) * direction).z);
  float share = (value - range.x) / (range.y - range.x);
  color = isnan(share) ? vec4(0.5, 0.5, 0.5, 1.0) : texture(colors, vec2(0.5 / 256.0 + clamp(share, 0.0, 1.0) * 255.0 / 256.0, 0.5));
  facing = vec4(0.5 - 0.5 * (off + dip * direction) / extent, 2.0 / 3.0);
}
)";

constexpr std::string_view solid_vertex = R"(
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 corner_normal;
out vec3 world;
out vec3 normal;
void main() {
  world = corner;
  normal = turn * corner_normal;
  gl_Position = projection * vec4(to_view(corner), 1.0);
}
)";

constexpr std::string_view solid_fragment = R"(
in vec3 world;
in vec3 normal;
uniform vec3 skin;
layout(location = 0) out vec4 color;
layout(location = 1) out vec4 facing;
void main() {
  if (left_out(world)) discard;
  vec3 towards = is_parallel ? vec3(0.0, 0.0, -1.0) : to_view(world);
  vec3 n = normalize(normal);
  if (dot(n, towards) > 0.0) n = -n;
  color = vec4(skin, 1.0);
  facing = vec4(0.5 + 0.5 * n, 1.0 / 3.0);
}
)";

constexpr std::string_view ground_vertex = R"(
uniform vec3 centre;  // on the ground
uniform vec3 side;
uniform vec3 ahead;
uniform float reach;
out vec2 way;
void main() {
  way = vec2(gl_VertexID % 2 == 0 ? -1.0 : 1.0, gl_VertexID / 2 == 0 ? -1.0 : 1.0);
  gl_Position = projection * vec4(to_view(centre + reach * (way.x * side + way.y * ahead)), 1.0);
}
)";

constexpr std::string_view ground_fragment = R"(
in vec2 way;
uniform vec3 skin;
uniform vec3 ground_normal;
layout(location = 0) out vec4 color;
layout(location = 1) out vec4 facing;
void main() {
  float far = length(way);
  if (far > 1.0) discard;
  color = vec4(skin, 1.0 - smoothstep(0.25, 1.0, far));  // fades into the background
  facing = vec4(0.5 + 0.5 * (turn * ground_normal), 1.0);
}
)";

constexpr int color_count = 256;
constexpr Vec3d solid_color{0.765, 0.76, 0.75};
constexpr Vec3d ground_color{0.81, 0.82, 0.83};

}  // namespace

ScenePass::ScenePass()
    : spheres_("particles", {glsl_lens, glsl_clip}, glsl_spheres, sphere_fragment),
      solids_("solids", {glsl_lens, glsl_clip}, solid_vertex, solid_fragment),
      ground_("ground", {glsl_lens}, ground_vertex, ground_fragment) {
  std::vector<std::uint8_t> bytes;
  for (const Rgb& color : color_map(color_count)) {
    for (const double c : color) bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * c)));
    bytes.push_back(255);
  }
  gl::filter_smoothly(colors_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, color_count, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
}

void ScenePass::draw(const gl::Target& target, const SceneView& view, const Spheres& spheres, const Solids& solids,
                     const Skin& skin) const {
  target.draw_here();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (view.solids || view.skin) {
    solids_.use();
    view.lens.set(solids_);
    set_clip(solids_, view.clip);
    solids_.set("skin", solid_color);
    if (view.solids) solids.draw();
    if (view.skin) skin.draw();
  }
  glBindVertexArray(nothing_.name());
  if (view.ground) {
    ground_.use();
    view.lens.set(ground_);
    const Vec3d& up = view.up;
    const Vec3d across = cross(up, std::abs(up.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0});
    const Vec3d side = 1 / length(across) * across;
    ground_.set("centre", view.centre + (view.ground_height - dot(view.centre, up)) * up);
    ground_.set("side", side);
    ground_.set("ahead", cross(up, side));
    ground_.set("reach", view.reach);
    ground_.set("ground_normal", up);
    ground_.set("skin", ground_color);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  if (view.spheres) {
    spheres_.use();
    view.lens.set(spheres_);
    set_clip(spheres_, view.clip);
    spheres_.set("picture", static_cast<float>(target.width()), static_cast<float>(target.height()));
    spheres_.set("range", view.range.first, view.range.second);
    spheres_.bind("colors", 0, colors_.name());
    spheres.draw(spheres_, view.radius, 2 * view.lens.slope_y / target.height());
  }
  glDisable(GL_DEPTH_TEST);
}

}  // namespace sessile::draw
