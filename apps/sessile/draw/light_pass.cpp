#include "draw/light_pass.h"

namespace sessile::draw {

const std::string_view glsl_surroundings = R"(
uniform vec3 lamp;
uniform vec3 above;
vec3 linear(vec3 stored) { return pow(stored, vec3(2.2)); }
vec3 background(vec2 place) {
  vec2 off = place - vec2(0.5, 0.62);
  float edge = clamp(dot(off, off) * 1.7, 0.0, 1.0);
  return linear(mix(vec3(0.93, 0.945, 0.96), vec3(0.765, 0.80, 0.835), edge));
}
// Light from the sky all around on a surface that faces there.
vec3 ambient(vec3 normal) { return mix(vec3(0.36, 0.345, 0.33), vec3(0.60, 0.63, 0.67), 0.5 + 0.5 * dot(normal, above)); }
// What stands in that direction: a pale floor, a horizon, a sky that darkens upwards, the lamp as a large soft box and
// a narrow one opposite. What lies beyond the scene is the picture's background.
vec3 surroundings(vec3 direction) {
  float height = dot(direction, above);
  vec3 sky = mix(vec3(0.58, 0.64, 0.71), vec3(0.10, 0.19, 0.32), smoothstep(0.02, 0.75, height));
  vec3 color = mix(vec3(0.22, 0.23, 0.25), sky, smoothstep(-0.12, 0.06, height));
  color = mix(color, vec3(0.52, 0.56, 0.60), smoothstep(0.2, 0.95, -direction.z));
  color += vec3(1.7, 1.65, 1.55) * smoothstep(0.88, 0.92, dot(direction, lamp));
  vec3 opposite = normalize(2.0 * dot(lamp, above) * above - lamp);
  return color + vec3(0.55, 0.58, 0.62) * smoothstep(0.95, 0.97, dot(direction, opposite));
}
)";

namespace {

// How much of the sky (x) and of the lamp (y) reaches a place. Crevices: Alchemy's estimate (McGuire et al. 2011);
// shadows: their softness from the distance of what casts them (Fernando 2005).
constexpr std::string_view look_around_fragment = R"(
in vec2 place;
uniform sampler2D facing_map;
uniform sampler2D depth_map;
uniform sampler2D shadow_map;
uniform vec3 light_centre;
uniform mat3 light_turn;
uniform float light_reach;
uniform float near_by;    // what crevices reach [m]
uniform float aspect;
out vec4 visible;
const int around = 12;
const float golden = 2.3999632;

float crevices(vec3 seen, vec3 normal, float turned) {
  float size = 0.5 * near_by / (is_parallel ? slope.y : -seen.z * slope.y);
  size = clamp(size, 0.004, 0.12);
  float sum = 0.0;
  for (int k = 0; k < around; ++k) {
    float share = (float(k) + 0.5) / float(around), angle = turned + golden * float(k) * 3.0;
    vec2 there = place + size * share * vec2(cos(angle) / aspect, sin(angle));
    float depth = textureLod(depth_map, there, 0.0).r;
    if (depth >= 1.0) continue;
    vec3 way = view_place(there, z_at(depth)) - seen;
    float far = dot(way, way), reach = near_by * near_by;
    float fade = max(0.0, 1.0 - far / reach);
    sum += fade * max(0.0, dot(way, normal) - 0.02 * near_by) / (sqrt(far) + 0.02 * near_by);
  }
  return clamp(1.0 - 1.7 * sum / float(around), 0.0, 1.0);
}

float lamp_share(vec3 seen, vec3 normal, float turned) {
  vec3 world = to_world(seen);
  vec3 world_normal = normal * turn;
  float texel = 2.0 * light_reach / float(textureSize(shadow_map, 0).x);
  vec3 l = light_turn * (world + 2.0 * texel * world_normal - light_centre) / light_reach;
  vec2 at = 0.5 + 0.5 * l.xy;
  float slant = max(0.15, dot(vec3(0.0, 0.0, 1.0) * light_turn, world_normal));
  float own = 0.5 - 0.5 * l.z - 0.5 * texel / light_reach / slant;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)))) return 1.0;
  float nearest = 0.6 * near_by / light_reach, sum = 0.0, count = 0.0;
  float single = 1.0 / float(textureSize(shadow_map, 0).x), look = max(nearest, 4.0 * single);
  for (int k = 0; k < 10; ++k) {
    float angle = turned + golden * float(k);
    float caster = textureLod(shadow_map, at + look * sqrt((float(k) + 0.5) / 10.0) * vec2(cos(angle), sin(angle)), 0.0).r;
    if (caster < own) { sum += caster; count += 1.0; }
  }
  if (count == 0.0) return 1.0;
  float soft = clamp(0.16 * (own - sum / count), single, 3.0 * look);
  float lit = 0.0;
  for (int k = 0; k < 14; ++k) {
    float share = sqrt((float(k) + 0.5) / 14.0), angle = turned + golden * float(k);
    float bias = soft * share * 0.5;  // what is tilted to the light must not shade itself
    lit += textureLod(shadow_map, at + soft * share * vec2(cos(angle), sin(angle)), 0.0).r < own - bias ? 0.0 : 1.0;
  }
  return lit / 14.0;
}

void main() {
  vec4 facing = textureLod(facing_map, place, 0.0);
  visible = vec4(1.0);
  if (facing.a < 0.1) return;
  vec3 normal = normalize(2.0 * facing.xyz - 1.0);
  vec3 seen = view_place(place, z_at(textureLod(depth_map, place, 0.0).r));
  float turned = 6.2831853 * noise_at(gl_FragCoord.xy);
  visible.x = crevices(seen, normal, turned);
  visible.y = lamp_share(seen, normal, turned);
}
)";

// Evens out the noise along one axis, not across edges.
constexpr std::string_view blur_fragment = R"(
in vec2 place;
uniform sampler2D rough_map;
uniform sampler2D depth_map;
uniform vec2 along;
uniform float near_by;
out vec4 visible;
void main() {
  float z = z_at(textureLod(depth_map, place, 0.0).r);
  vec2 sum = textureLod(rough_map, place, 0.0).xy;
  float weights = 1.0;
  for (int k = -3; k <= 3; ++k) {
    if (k == 0) continue;
    vec2 there = place + float(k) * along;
    float off = (z_at(textureLod(depth_map, there, 0.0).r) - z) / (0.25 * near_by);
    float weight = exp(-0.12 * float(k * k) - off * off);
    sum += weight * textureLod(rough_map, there, 0.0).xy;
    weights += weight;
  }
  visible = vec4(sum / weights, 0.0, 1.0);
}
)";

constexpr std::string_view shade_fragment = R"(
in vec2 place;
uniform sampler2D color_map;
uniform sampler2D facing_map;
uniform sampler2D depth_map;
uniform sampler2D visible_map;
uniform float near_by;
uniform vec3 shadow;
out vec4 lit;

// What has been looked up for fewer pixels, from those of them that lie as far away.
vec2 visible_here(float z) {
  vec2 size = vec2(textureSize(visible_map, 0));
  vec2 at = place * size - 0.5, low = floor(at), share = at - low, sum = vec2(0.0);
  float weights = 0.0;
  for (int k = 0; k < 4; ++k) {
    vec2 step_by = vec2(k % 2, k / 2);
    vec2 there = (low + step_by + 0.5) / size;
    float off = (z_at(textureLod(depth_map, there, 0.0).r) - z) / (0.25 * near_by);
    vec2 part = mix(1.0 - share, share, step_by);
    float weight = (part.x * part.y + 1e-3) * (exp(-off * off) + 1e-4);
    sum += weight * textureLod(visible_map, there, 0.0).xy;
    weights += weight;
  }
  return sum / weights;
}

void main() {
  vec3 behind = background(place);
  vec4 facing = textureLod(facing_map, place, 0.0);
  lit = vec4(behind, 1.0);
  if (facing.a < 0.1) return;
  vec4 color = textureLod(color_map, place, 0.0);
  float z = z_at(textureLod(depth_map, place, 0.0).r);
  vec3 normal = normalize(2.0 * facing.xyz - 1.0);
  vec2 visible = visible_here(z);
  vec3 sunlit = max(0.0, dot(normal, lamp)) * mix(shadow, vec3(1.0), visible.y);
  vec3 light = ambient(normal) * mix(0.25, 1.0, visible.x) + vec3(0.66, 0.645, 0.61) * sunlit;
  vec3 shine = vec3(0.0);
  if (facing.a > 0.5 && facing.a < 0.8) {
    vec3 half_way = normalize(lamp - ray_direction(place));
    shine = vec3(0.10) * pow(max(0.0, dot(normal, half_way)), 30.0) * visible.y;
  }
  lit.rgb = mix(behind, linear(color.rgb) * light + shine, color.a);
}
)";

}  // namespace

void Light::set(const gl::Program& program, const Lens& seen_by) const {
  const auto turned = [&](const Vec3d& v) {
    return Vec3d{dot(v, seen_by.right), dot(v, seen_by.upward), dot(v, seen_by.backward)};
  };
  program.set("lamp", turned(lens.backward));
  program.set("above", turned(up));
}

LightPass::LightPass()
    : look_around_("crevices and shadows", {glsl_lens, glsl_noise}, glsl_whole_picture, look_around_fragment),
      blur_("evening out", {glsl_lens}, glsl_whole_picture, blur_fragment),
      shade_("light", {glsl_lens, glsl_surroundings}, glsl_whole_picture, shade_fragment) {}

void LightPass::draw(const gl::Target& scene, const gl::Target& rough, const gl::Target& other_rough,
                     const gl::Target& lit, const Lens& lens, const Light& light) const {
  const double near_by = 3 * light.spacing;
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(nothing_.name());
  rough.draw_here();
  look_around_.use();
  lens.set(look_around_);
  look_around_.bind("facing_map", 0, scene.color(1));
  look_around_.bind("depth_map", 1, scene.depth());
  look_around_.bind("shadow_map", 2, light.shadows);
  look_around_.set("light_centre", light.lens.target);
  look_around_.set_turn("light_turn", light.lens.right, light.lens.upward, light.lens.backward);
  look_around_.set("light_reach", light.lens.slope_x);
  look_around_.set("near_by", near_by);
  look_around_.set("aspect", lens.slope_x / lens.slope_y);
  draw_whole_picture();

  blur_.use();
  lens.set(blur_);
  blur_.bind("depth_map", 1, scene.depth());
  blur_.set("near_by", near_by);
  other_rough.draw_here();
  blur_.bind("rough_map", 0, rough.color());
  blur_.set("along", 1.0F / static_cast<float>(rough.width()), 0.0F);
  draw_whole_picture();
  rough.draw_here();
  blur_.bind("rough_map", 0, other_rough.color());
  blur_.set("along", 0.0F, 1.0F / static_cast<float>(rough.height()));
  draw_whole_picture();

  lit.draw_here();
  shade_.use();
  lens.set(shade_);
  shade_.bind("color_map", 0, scene.color(0));
  shade_.bind("facing_map", 1, scene.color(1));
  shade_.bind("depth_map", 2, scene.depth());
  shade_.bind("visible_map", 3, rough.color());
  shade_.set("near_by", near_by);
  shade_.set("shadow", light.shadow);
  light.set(shade_, lens);
  draw_whole_picture();
}

}  // namespace sessile::draw
