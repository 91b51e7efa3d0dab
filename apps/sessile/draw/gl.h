#pragma once

#include <epoxy/gl.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sessile/core/vec.h"

/// Thin owners of OpenGL's objects. All of them need a current context for all they do, their destructors among it.
namespace sessile::draw::gl {

/// Owns the name of one object. `Kind` makes and frees it.
template <class Kind>
class Object {
 public:
  Object() { Kind::make(&name_); }
  ~Object() {
    if (name_ != 0) Kind::free(&name_);
  }
  Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;

  GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

struct BufferKind {
  static void make(GLuint* name) { glGenBuffers(1, name); }
  static void free(const GLuint* name) { glDeleteBuffers(1, name); }
};
struct VertexArrayKind {
  static void make(GLuint* name) { glGenVertexArrays(1, name); }
  static void free(const GLuint* name) { glDeleteVertexArrays(1, name); }
};
struct TextureKind {
  static void make(GLuint* name) { glGenTextures(1, name); }
  static void free(const GLuint* name) { glDeleteTextures(1, name); }
};
struct FramebufferKind {
  static void make(GLuint* name) { glGenFramebuffers(1, name); }
  static void free(const GLuint* name) { glDeleteFramebuffers(1, name); }
};

using Buffer = Object<BufferKind>;
using VertexArray = Object<VertexArrayKind>;
using Texture = Object<TextureKind>;
using Framebuffer = Object<FramebufferKind>;

/// A linked pair of shaders.
class Program {
 public:
  /// `vertex` and `fragment` are put behind the version and the shared pieces. Throws Error with the compiler's words.
  Program(std::string_view name, std::initializer_list<std::string_view> shared, std::string_view vertex,
          std::string_view fragment);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { glUseProgram(name_); }

  // Sets a uniform of the program in use; one that the compiler has left out is passed over.
  void set(const char* uniform, int value) const { glUniform1i(place(uniform), value); }
  void set(const char* uniform, bool value) const { glUniform1i(place(uniform), value ? 1 : 0); }
  void set(const char* uniform, float value) const { glUniform1f(place(uniform), value); }
  void set(const char* uniform, double value) const { set(uniform, static_cast<float>(value)); }
  void set(const char* uniform, float x, float y) const { glUniform2f(place(uniform), x, y); }
  void set(const char* uniform, const Vec3d& value) const;
  void set(const char* uniform, float x, float y, float z, float w) const { glUniform4f(place(uniform), x, y, z, w); }
  void set_turn(const char* uniform, const Vec3d& x, const Vec3d& y, const Vec3d& z) const;  ///< rows of a 3 x 3
  void set_matrix(const char* uniform, const float* columns) const;

  /// Binds a texture to a unit and says so to the program.
  void bind(const char* uniform, int unit, GLuint texture, GLenum kind = GL_TEXTURE_2D) const;

 private:
  GLint place(const char* uniform) const { return glGetUniformLocation(name_, uniform); }

  GLuint name_ = 0;
};

/// Textures of one size to draw into; `depth` adds one of depths.
class Target {
 public:
  Target(int width, int height, std::initializer_list<GLenum> formats, bool depth = false);

  void draw_here() const;  ///< makes it the framebuffer, its whole area the viewport
  GLuint color(int which = 0) const { return colors_[static_cast<std::size_t>(which)].name(); }
  GLuint depth() const { return depth_.front().name(); }
  GLuint framebuffer() const { return framebuffer_.name(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_, height_;
  std::vector<Texture> colors_, depth_;
  Framebuffer framebuffer_;
};

/// How colours of a texture are looked up between its pixels.
void filter_smoothly(GLuint texture);

/// Copies numbers into a buffer, giving the driver leave to throw the old ones away: it need not wait for their use.
void upload(GLenum kind, const Buffer& buffer, const void* data, std::size_t bytes);

/// Throws Error when OpenGL has reported one since the last call; `during` is what was done.
void check(std::string_view during);

}  // namespace sessile::draw::gl
