#include "draw/finish_pass.h"

#include "draw/lens.h"

namespace sessile::draw {
namespace {

constexpr std::string_view stored = R"(
in vec2 place;
uniform sampler2D light_map;
out vec4 color;
vec3 stored(vec3 light) {
  vec3 c = clamp(light, 0.0, 1.0);
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThan(c, vec3(0.0031308)));
}
)";

constexpr std::string_view gather_fragment = R"(
uniform int fineness;
void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * fineness;
  vec3 sum = vec3(0.0);
  for (int y = 0; y < fineness; ++y) {
    for (int x = 0; x < fineness; ++x) sum += clamp(texelFetch(light_map, first + ivec2(x, y), 0).rgb, 0.0, 1.0);
  }
  color = vec4(stored(sum / float(fineness * fineness)), 1.0);
}
)";

// Softens steps along edges: looks how brightness changes around a pixel, and averages along the edge (after
// T. Lottes's FXAA of 2009, its console variant in outline).
constexpr std::string_view soften_fragment = R"(
vec3 light_at(ivec2 at) {
  return clamp(texelFetch(light_map, clamp(at, ivec2(0), textureSize(light_map, 0) - 1), 0).rgb, 0.0, 1.0);
}
vec3 light_near(vec2 there) { return clamp(textureLod(light_map, there, 0.0).rgb, 0.0, 1.0); }
float bright(vec3 light) { return sqrt(dot(light, vec3(0.299, 0.587, 0.114))); }
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 here = light_at(at);
  float a = bright(light_at(at + ivec2(-1, 1))), b = bright(light_at(at + ivec2(1, 1)));
  float c = bright(light_at(at + ivec2(-1, -1))), d = bright(light_at(at + ivec2(1, -1))), own = bright(here);
  float least = min(own, min(min(a, b), min(c, d))), most = max(own, max(max(a, b), max(c, d)));
  if (most - least >= max(0.04, 0.12 * most)) {
    vec2 along = vec2(c + d - a - b, a + c - b - d);
    float steep = min(abs(along.x), abs(along.y)) + max(0.03 * (a + b + c + d), 0.008);
    along = clamp(along / steep, -6.0, 6.0) / vec2(textureSize(light_map, 0));
    vec3 close = 0.5 * (light_near(place - along / 6.0) + light_near(place + along / 6.0));
    vec3 wide = 0.5 * close + 0.25 * (light_near(place - 0.5 * along) + light_near(place + 0.5 * along));
    float w = bright(wide);
    here = w < least || w > most ? close : wide;
  }
  color = vec4(stored(here), 1.0);
}
)";

}  // namespace

FinishPass::FinishPass()
    : gather_("gathering", {}, glsl_whole_picture, std::string(stored) + std::string(gather_fragment)),
      soften_("softening", {}, glsl_whole_picture, std::string(stored) + std::string(soften_fragment)) {}

void FinishPass::draw(GLuint light, int fineness, int width, int height, GLuint framebuffer) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(nothing_.name());
  const gl::Program& program = fineness == 1 ? soften_ : gather_;
  program.use();
  program.bind("light_map", 0, light);
  program.set("fineness", fineness);
  draw_whole_picture();
}

}  // namespace sessile::draw
