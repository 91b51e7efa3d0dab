#include "draw/liquid_shaders.h"

namespace sessile::draw::liquid_shaders {

const std::string_view sphere_depth = R"(
flat in vec3 centre;
flat in float extent;
flat in float value;
uniform vec2 picture;
uniform sampler2D scene_depth;
layout(location = 0) out float distance_to_eye;
layout(location = 1) out vec4 normal;
void main() {
  vec2 place = gl_FragCoord.xy / picture;
  vec3 direction = ray_direction(place), start = ray_start(place);
  float closest = dot(direction, centre - start);
  vec3 off = centre - start - closest * direction;
  float left = extent * extent - dot(off, off);
  if (left < 0.0) discard;
  float z = (start + (closest - sqrt(left)) * direction).z;
  float depth = depth_at(z);
  if (depth > textureLod(scene_depth, place, 0.0).r) discard;  // behind a solid
  gl_FragDepth = depth;
  distance_to_eye = -z;
  normal = vec4(0.0);
}
)";

// Each sphere adds its chord, scaled so that all chords together are the particle's volume.
const std::string_view sphere_thickness = R"(
flat in vec3 centre;
flat in float extent;
flat in float value;
uniform vec2 picture;
uniform sampler2D scene_depth;
uniform float spacing;
layout(location = 0) out float thickness;
void main() {
  vec2 place = gl_FragCoord.xy / picture;
  vec3 direction = ray_direction(place), start = ray_start(place);
  float closest = dot(direction, centre - start);
  vec3 off = centre - start - closest * direction;
  float left = extent * extent - dot(off, off);
  if (left < 0.0) discard;
  if (depth_at((start + closest * direction).z) > textureLod(scene_depth, place, 0.0).r + 1e-4) discard;
  float ratio = spacing / extent;
  thickness = 2.0 * sqrt(left) * 0.2387324 * ratio * ratio * ratio / spacing;
}
)";

const std::string_view skin_vertex = R"(
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 corner_normal;
out vec3 world;
out vec3 seen;
out vec3 facing;
void main() {
  world = corner;
  seen = to_view(corner);
  facing = turn * corner_normal;
  gl_Position = projection * vec4(seen, 1.0);
}
)";

const std::string_view skin_depth = R"(
in vec3 world;
in vec3 seen;
in vec3 facing;
uniform vec2 picture;
uniform sampler2D scene_depth;
layout(location = 0) out float distance_to_eye;
layout(location = 1) out vec4 normal;
void main() {
  if (left_out(world)) discard;
  vec2 place = gl_FragCoord.xy / picture;
  if (gl_FragCoord.z > textureLod(scene_depth, place, 0.0).r) discard;
  distance_to_eye = -seen.z;
  vec3 n = normalize(facing);
  if (!gl_FrontFacing) n = -n;
  normal = vec4(0.5 + 0.5 * n, 1.0);
}
)";

// Ways out of the liquid count, ways in are taken off: what is left is the way through it. A solid inside ends the way.
const std::string_view skin_thickness = R"(
in vec3 world;
in vec3 seen;
in vec3 facing;
uniform vec2 picture;
uniform sampler2D scene_depth;
uniform float spacing;
layout(location = 0) out float thickness;
void main() {
  vec2 place = gl_FragCoord.xy / picture;
  float solid = z_at(textureLod(scene_depth, place, 0.0).r);
  float z = max(seen.z, solid);
  float along = is_parallel ? -z : length(view_place(place, z));
  thickness = (gl_FrontFacing ? -1.0 : 1.0) * (along - away) / spacing;
}
)";

// One axis of the narrow-range filter (Truong and Yuksel 2018): what lies far in front is another body and left out,
// with its opposite, so that the mean does not tilt; what lies far behind counts as if it were just behind.
const std::string_view smooth = R"(
in vec2 place;
uniform sampler2D front;
uniform sampler2D scene_depth;
uniform vec2 axis;      // of the picture
uniform float reach;    // of the filter [m]
uniform float narrow;   // how far apart two places of one body may be [m]
layout(location = 0) out float distance_to_eye;
const int taps = 10;
float front_at(vec2 there, float own) {
  float d = textureLod(front, there, 0.0).r;
  if (d > 0.0) return d;
  // No liquid: it runs out on what lies behind.
  return min(-z_at(textureLod(scene_depth, there, 0.0).r), own + 0.7 * narrow);
}
void main() {
  float own = textureLod(front, place, 0.0).r;
  distance_to_eye = own;
  if (own <= 0.0) return;
  float height = 2.0 * (is_parallel ? slope.y : slope.y * own);
  vec2 pixel = 1.0 / vec2(textureSize(front, 0));
  // In shares of the picture's height; at least a pixel between two taps, and no further than a sixth of the picture.
  float stride = clamp(reach / height / float(taps), pixel.y, 0.16 / float(taps));
  int count = int(min(float(taps), ceil(reach / height / stride)));
  vec2 by = axis * stride * vec2(pixel.x / pixel.y, 1.0);
  float sum = own, weights = 1.0;
  for (int k = 1; k <= count; ++k) {
    float a = front_at(place + float(k) * by, own), b = front_at(place - float(k) * by, own);
    float near = min(a, b) - own;
    if (near < -narrow) continue;
    float share = float(k) / float(taps), weight = exp(-3.0 * share * share) * smoothstep(-narrow, -0.6 * narrow, near);
    sum += weight * (min(a, own + narrow) + min(b, own + narrow));
    weights += 2.0 * weight;
  }
  distance_to_eye = sum / weights;
}
)";

// A last round in all directions, which takes away what the two axes leave.
const std::string_view polish = R"(
in vec2 place;
uniform sampler2D front;
uniform float reach;
uniform float narrow;
layout(location = 0) out float distance_to_eye;
const int pairs = 12;
void main() {
  float own = textureLod(front, place, 0.0).r;
  distance_to_eye = own;
  if (own <= 0.0) return;
  vec2 pixel = 1.0 / vec2(textureSize(front, 0));
  float size = clamp(reach / (2.0 * (is_parallel ? slope.y : slope.y * own)), 1.5 * pixel.y, 0.05);
  vec2 extent = size * vec2(pixel.x / pixel.y, 1.0);
  float sum = own, weights = 1.0;
  for (int k = 0; k < pairs; ++k) {
    float share = sqrt((float(k) + 0.5) / float(pairs)), angle = 2.3999632 * float(k);
    vec2 by = share * extent * vec2(cos(angle), sin(angle));
    float a = textureLod(front, place + by, 0.0).r, b = textureLod(front, place - by, 0.0).r;
    float weight = exp(-2.0 * share * share);
    if (a <= 0.0 || b <= 0.0) continue;
    weight *= smoothstep(-0.8 * narrow, -0.3 * narrow, -abs(0.5 * (a + b) - own));  // both sides of a slope even out
    sum += weight * (a + b);
    weights += 2.0 * weight;
  }
  distance_to_eye = sum / weights;
}
)";

const std::string_view compose = R"(
in vec2 place;
uniform sampler2D front;
uniform sampler2D normals;
uniform sampler2D thickness_map;
uniform sampler2D scene_depth;
uniform sampler2D lit_map;
uniform bool has_normals;
uniform float spacing;
uniform float rim;
out vec4 lit;

vec3 place_of(vec2 there) { return view_place(there, -textureLod(front, there, 0.0).r); }

// Of two differences the smaller: the other one may lead across an edge.
vec3 slope_along(vec3 here, vec2 by) {
  vec3 ahead = place_of(place + by) - here, behind = here - place_of(place - by);
  bool no_ahead = textureLod(front, place + by, 0.0).r <= 0.0, no_behind = textureLod(front, place - by, 0.0).r <= 0.0;
  if (no_ahead && no_behind) return vec3(by, 0.0);
  if (no_ahead) return behind;
  if (no_behind) return ahead;
  if (abs(ahead.z - behind.z) < 0.35 * spacing) return ahead + behind;
  return abs(ahead.z) < abs(behind.z) ? ahead : behind;
}

void main() {
  vec3 behind = textureLod(lit_map, place, 0.0).rgb;
  lit = vec4(behind, 1.0);
  float own = textureLod(front, place, 0.0).r;
  if (own <= 0.0) return;
  vec3 here = view_place(place, -own);
  vec2 pixel = 1.0 / vec2(textureSize(front, 0));
  // A tenth of a particle apart, so that what noise is left does not glitter.
  float height = 2.0 * (is_parallel ? slope.y : slope.y * own);
  pixel *= floor(clamp(0.1 * spacing / height / pixel.y, 1.0, 12.0));
  vec3 normal;
  if (has_normals) {
    normal = normalize(2.0 * textureLod(normals, place, 0.0).xyz - 1.0);
  } else {
    normal = normalize(cross(slope_along(here, vec2(pixel.x, 0.0)), slope_along(here, vec2(0.0, pixel.y))));
  }
  vec3 ray = ray_direction(place);
  float facing = clamp(-dot(normal, ray), 0.0, 1.0);
  float thickness = max(0.0, textureLod(thickness_map, place, 0.0).r);

  // What is seen through it, where the bent ray leaves it.
  vec3 bent = refract(ray, normal, 0.75);
  vec3 exit = here + 0.75 * thickness * spacing * bent;
  vec2 seen_at = clamp(picture_place(exit), vec2(0.001), vec2(0.999));
  float solid = z_at(textureLod(scene_depth, seen_at, 0.0).r);
  if (solid > here.z) seen_at = place;  // in front of the liquid
  vec3 through = textureLod(lit_map, seen_at, 0.0).rgb;
  if (textureLod(scene_depth, seen_at, 0.0).r >= 1.0) {
    // Nothing behind: a rim bends the ray aside, to where it is darker than beyond the scene.
    through *= surroundings(normalize(ray + 2.2 * (bent - ray))) / surroundings(ray);
  }
  // Where it runs out the outline is that of the thickness, which is rounder than that of spheres; `rim` is what a single
  // particle has near its own. Inside it there is some colour at once.
  float there = has_normals ? 1.0 : smoothstep(0.8 * rim, 1.2 * rim, thickness);
  thickness += 0.5;
  // Deep liquid lets through more than its depth would: a pool shall not be black.
  float deep = thickness / (1.0 + 0.12 * thickness);
  vec3 body = vec3(0.015, 0.13, 0.22) * (0.6 + 0.5 * max(0.0, dot(normal, lamp)));
  through = through * exp(-deep * vec3(0.42, 0.145, 0.06)) + body * (1.0 - exp(-0.12 * deep));

  through *= 1.0 - 0.45 * pow(1.0 - facing, 2.0);  // a steep side bends rays to where it is darker
  float mirrored = 0.04 + 0.96 * pow(1.0 - facing, 5.0);
  vec3 mirror_ray = reflect(ray, normal);
  vec3 mirror = mix(surroundings(mirror_ray), behind, smoothstep(0.3, 0.95, -mirror_ray.z));  // grazing: straight on
  vec3 half_way = normalize(lamp - ray);
  float glint = pow(max(0.0, dot(normal, half_way)), 220.0);
  lit.rgb = mix(behind, mix(through, mirror, mirrored) + vec3(1.3) * glint, there);
}
)";

}  // namespace sessile::draw::liquid_shaders
