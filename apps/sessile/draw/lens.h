#pragma once

#include <string_view>

#include "draw/camera.h"
#include "draw/gl.h"

namespace sessile::draw {

/// Where a pass looks from, as its shaders know it: that of the camera, or the light's.
struct Lens {
  Vec3d target{};                       ///< [m]
  Vec3d right{}, upward{}, backward{};  ///< the view's axes; it looks against the last
  double away = 1;                      ///< from the eye to the target [m]
  double slope_x = 1, slope_y = 1;      ///< half width and height: over the distance, or in metres of a parallel one
  bool parallel = false;                ///< orthographic
  Matrix projection{};

  void set(const gl::Program& program) const;
};

/// The lens of a camera, enclosing a ball around its target of that radius [m].
Lens lens_of(const Camera& camera, double aspect, double radius);

/// That of a light from far away, which sees a ball.
Lens lens_of_light(const Vec3d& towards_light, const Vec3d& centre, double radius);

/// What shaders share. Places are seen from the eye (x right, y up, z backward); `place` on the picture is from 0 to 1.
inline constexpr std::string_view glsl_lens = R"(
uniform vec3 target;
uniform mat3 turn;
uniform float away;
uniform mat4 projection;
uniform vec2 slope;
uniform bool is_parallel;

vec3 to_view(vec3 world) { return turn * (world - target) - vec3(0.0, 0.0, away); }
vec3 to_world(vec3 seen) { return target + (seen + vec3(0.0, 0.0, away)) * turn; }
float depth_at(float z) {
  float across = is_parallel ? projection[2][2] * z + projection[3][2] : -projection[2][2] - projection[3][2] / z;
  return 0.5 + 0.5 * across;
}
float z_at(float depth) {
  float across = 2.0 * depth - 1.0;
  return is_parallel ? (across - projection[3][2]) / projection[2][2] : -projection[3][2] / (across + projection[2][2]);
}
vec3 view_place(vec2 place, float z) {
  vec2 xy = (2.0 * place - 1.0) * slope;
  return vec3(is_parallel ? xy : -z * xy, z);
}
// The ray through a place of the picture: a point of it and its direction.
vec3 ray_start(vec2 place) { return is_parallel ? vec3((2.0 * place - 1.0) * slope, 0.0) : vec3(0.0); }
vec3 ray_direction(vec2 place) {
  return is_parallel ? vec3(0.0, 0.0, -1.0) : normalize(vec3((2.0 * place - 1.0) * slope, -1.0));
}
vec2 picture_place(vec3 seen) {
  vec4 p = projection * vec4(seen, 1.0);
  return 0.5 + 0.5 * p.xy / p.w;
}
)";

/// Numbers between 0 and 1 that look random from pixel to pixel but spread evenly (J. Jimenez 2014).
inline constexpr std::string_view glsl_noise = R"(
float noise_at(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }
)";

/// One triangle over the whole picture.
inline constexpr std::string_view glsl_whole_picture = R"(
out vec2 place;
void main() {
  place = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
}
)";

/// Draws that triangle; a vertex array must be bound.
inline void draw_whole_picture() { glDrawArrays(GL_TRIANGLES, 0, 3); }

}  // namespace sessile::draw
