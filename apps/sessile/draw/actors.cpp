#include "draw/actors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "sessile/core/error.h"

namespace sessile::draw {
namespace {

/// Cosine of the sharpest angle between two faces that is shaded as if it were round.
constexpr double round_cosine = 0.8;

/// A face's normal, as long as twice its area.
Vec3d face_normal(const TriangleMesh& mesh, std::size_t face) {
  const auto& t = mesh.triangles[face];
  return cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

/// A count as OpenGL takes it. Throws Error where that is more than it draws at once.
int drawn_count(std::size_t count, std::int64_t most, std::string_view things) {
  if (count <= static_cast<std::size_t>(most)) return static_cast<int>(count);
  throw Error(fmt::format("the graphics driver draws at most {} {} at once, and there are {}", most, things, count));
}

constexpr std::int64_t most_corners = std::numeric_limits<GLsizei>::max();

/// The triangles' corners one by one, each with the mean normal of the faces that meet there and belong to one round
/// surface.
void add_corners(const TriangleMesh& mesh, std::vector<float>& corners) {
  std::vector<std::vector<std::size_t>> faces(mesh.vertices.size());
  std::vector<Vec3d> normals;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    normals.push_back(face_normal(mesh, k));
    for (const std::uint32_t v : mesh.triangles[k]) faces[v].push_back(k);
  }
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    for (const std::uint32_t v : mesh.triangles[k]) {
      Vec3d sum{};
      for (const std::size_t other : faces[v]) {
        const double cosine = dot(normals[k], normals[other]);
        if (cosine >= round_cosine * length(normals[k]) * length(normals[other])) sum += normals[other];
      }
      const double size = length(sum);
      const Vec3d normal = size > 0 ? 1 / size * sum : Vec3d{0, 0, 1};
      const Vec3d& p = mesh.vertices[v];
      for (const double x : {p.x, p.y, p.z, normal.x, normal.y, normal.z}) corners.push_back(static_cast<float>(x));
    }
  }
}

void read_floats(GLuint place, int stride_floats, int first) {
  glEnableVertexAttribArray(place);
  const auto bytes = static_cast<std::size_t>(first) * sizeof(float);
  glVertexAttribPointer(place, 3, GL_FLOAT, GL_FALSE, stride_floats * static_cast<int>(sizeof(float)),
                        reinterpret_cast<const void*>(bytes));  // NOLINT: OpenGL takes offsets as pointers
}

}  // namespace

void set_clip(const gl::Program& program, const std::optional<ClippingPlane>& clip) {
  program.set("is_clipped", clip.has_value());
  if (!clip) return;
  const auto n = vec_cast<float>(clip->normal);
  program.set("clip", n.x, n.y, n.z, static_cast<float>(clip->offset));
}

const std::string_view glsl_spheres = R"(
uniform samplerBuffer particles;
uniform float radius;
uniform float pixel;  // size of one over the distance, or in metres of a parallel lens
flat out vec3 centre;
flat out float extent;
flat out float value;
void main() {
  vec4 particle = texelFetch(particles, gl_VertexID / 3);
  int corner = gl_VertexID % 3;
  centre = to_view(particle.xyz);
  value = particle.w;
  float from_eye = length(centre);
  extent = max(radius, 0.6 * pixel * (is_parallel ? 1.0 : -centre.z));
  if (left_out(particle.xyz) || (!is_parallel && (centre.z > -1e-4 * away || from_eye <= 1.01 * extent))) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside
    return;
  }
  // A triangle around the circle in which the cone from the eye touches the sphere, at the centre's distance.
  vec3 towards = is_parallel ? vec3(0.0, 0.0, -1.0) : centre / from_eye;
  float reach = is_parallel ? extent : extent * from_eye / sqrt(from_eye * from_eye - extent * extent);
  vec3 across = normalize(cross(towards, abs(towards.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
  vec3 along = cross(across, towards);
  vec2 way = corner == 0 ? vec2(0.0, 2.0) : vec2(corner == 1 ? -1.7320508 : 1.7320508, -1.0);
  gl_Position = projection * vec4(centre + 1.01 * reach * (way.x * across + way.y * along), 1.0);
}
)";

Spheres::Spheres() {
  glBindBuffer(GL_TEXTURE_BUFFER, numbers_.name());
  glBindTexture(GL_TEXTURE_BUFFER, texture_.name());
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, numbers_.name());
}

void Spheres::show(const Moment& moment) {
  const std::size_t n = moment.points.size() / 3;
  GLint most_texels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most_texels);
  count_ = drawn_count(n, std::min<std::int64_t>(most_texels, most_corners / 3), "particles");
  glBindBuffer(GL_TEXTURE_BUFFER, numbers_.name());
  glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(std::max<std::size_t>(n, 1) * 4 * sizeof(float)), nullptr,
               GL_STREAM_DRAW);
  if (n == 0) return;
  // Written where the card reads it, with no copy in between.
  void* mapped = glMapBufferRange(GL_TEXTURE_BUFFER, 0, static_cast<GLsizeiptr>(n * 4 * sizeof(float)),
                                  GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
  gl::check("making room for particles");
  const bool has_values = moment.values.size() == n;
  const std::span<float> numbers(static_cast<float*>(mapped), 4 * n);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) numbers[4 * k + axis] = moment.points[3 * k + axis];
    numbers[4 * k + 3] = has_values ? moment.values[k] : 0;
  }
  glUnmapBuffer(GL_TEXTURE_BUFFER);
}

void Spheres::draw(const gl::Program& program, double radius, double pixel) const {
  if (count_ == 0) return;
  program.bind("particles", 7, texture_.name(), GL_TEXTURE_BUFFER);
  program.set("radius", radius);
  program.set("pixel", pixel);
  glDrawArrays(GL_TRIANGLES, 0, 3 * count_);
}

Solids::Solids(const Stage& stage) {
  std::vector<float> two_sided, inward;
  for (const SolidMesh& solid : stage.solids) {
    // A container's faces look inwards: those nearest the eye are seen from behind and left out.
    const bool holds_liquid = solid.mesh.closed() && solid.mesh.volume() < 0;
    add_corners(solid.mesh, holds_liquid ? inward : two_sided);
  }
  two_sided_ = drawn_count(two_sided.size() / 6, most_corners, "corners of solids");
  inward_ = drawn_count(inward.size() / 6, most_corners - two_sided_, "corners of containers");
  two_sided.insert(two_sided.end(), inward.begin(), inward.end());
  glBindVertexArray(array_.name());
  gl::upload(GL_ARRAY_BUFFER, corners_, two_sided.data(), two_sided.size() * sizeof(float));
  read_floats(0, 6, 0);
  read_floats(1, 6, 3);
}

void Solids::draw() const {
  glBindVertexArray(array_.name());
  if (two_sided_ > 0) glDrawArrays(GL_TRIANGLES, 0, two_sided_);
  if (inward_ == 0) return;
  glEnable(GL_CULL_FACE);
  glDrawArrays(GL_TRIANGLES, two_sided_, inward_);
  glDisable(GL_CULL_FACE);
}

Skin::Skin() {
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, places_.name());
  read_floats(0, 3, 0);
  glBindBuffer(GL_ARRAY_BUFFER, normals_.name());
  read_floats(1, 3, 0);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles_.name());
}

void Skin::show(const SurfaceMesh& mesh) {
  count_ = drawn_count(mesh.triangles.size(), most_corners, "corners of a surface");
  glBindVertexArray(array_.name());
  gl::upload(GL_ARRAY_BUFFER, places_, mesh.points.data(), mesh.points.size() * sizeof(float));
  gl::upload(GL_ARRAY_BUFFER, normals_, mesh.normals.data(), mesh.normals.size() * sizeof(float));
  gl::upload(GL_ELEMENT_ARRAY_BUFFER, triangles_, mesh.triangles.data(), mesh.triangles.size() * sizeof(std::uint32_t));
}

void Skin::draw() const {
  if (count_ == 0) return;
  glBindVertexArray(array_.name());
  glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace sessile::draw
