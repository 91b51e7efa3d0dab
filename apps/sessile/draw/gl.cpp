#include "draw/gl.h"

#include <fmt/format.h>

#include <array>

#include "sessile/core/error.h"

namespace sessile::draw::gl {
namespace {

/// A compiled shader, as long as the program that takes it needs it.
class Shader {
 public:
  Shader(GLenum kind, std::string_view name, const std::string& text) : name_(glCreateShader(kind)) {
    const char* start = text.c_str();
    glShaderSource(name_, 1, &start, nullptr);
    glCompileShader(name_);
    GLint done = GL_FALSE;
    glGetShaderiv(name_, GL_COMPILE_STATUS, &done);
    if (done == GL_TRUE) return;
    std::array<char, 2048> words{};
    glGetShaderInfoLog(name_, static_cast<GLsizei>(words.size()), nullptr, words.data());
    glDeleteShader(name_);
    throw Error(fmt::format("the OpenGL driver refuses the {} shader of \"{}\": {}",
                            kind == GL_VERTEX_SHADER ? "vertex" : "fragment", name, words.data()));
  }
  ~Shader() { glDeleteShader(name_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  GLuint name() const { return name_; }

 private:
  GLuint name_;
};

const char* error_word(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "invalid enum";
    case GL_INVALID_VALUE:
      return "invalid value";
    case GL_INVALID_OPERATION:
      return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY:
      return "out of memory";
    default:
      return "an unknown error";
  }
}

/// The kind of pixels that glTexImage2D is told for a format of a texture that gets none.
std::pair<GLenum, GLenum> pixels_of(GLenum format) {
  switch (format) {
    case GL_DEPTH_COMPONENT32F:
      return {GL_DEPTH_COMPONENT, GL_FLOAT};
    case GL_R16F:
    case GL_R32F:
      return {GL_RED, GL_FLOAT};
    case GL_RG8:
      return {GL_RG, GL_UNSIGNED_BYTE};
    case GL_RG32F:
      return {GL_RG, GL_FLOAT};
    case GL_RGBA16F:
      return {GL_RGBA, GL_FLOAT};
    default:
      return {GL_RGBA, GL_UNSIGNED_BYTE};
  }
}

Texture make_texture(int width, int height, GLenum format) {
  Texture texture;
  glBindTexture(GL_TEXTURE_2D, texture.name());
  const auto [order, type] = pixels_of(format);
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, order, type, nullptr);
  for (const GLenum way : std::initializer_list<GLenum>{GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_2D, way, GL_NEAREST);
  }
  for (const GLenum way : std::initializer_list<GLenum>{GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
    glTexParameteri(GL_TEXTURE_2D, way, GL_CLAMP_TO_EDGE);
  }
  return texture;
}

}  // namespace

Program::Program(std::string_view name, std::initializer_list<std::string_view> shared, std::string_view vertex,
                 std::string_view fragment) {
  std::string head = "#version 330 core\n";
  for (const std::string_view piece : shared) head += piece;
  const Shader first(GL_VERTEX_SHADER, name, head + std::string(vertex));
  const Shader second(GL_FRAGMENT_SHADER, name, head + std::string(fragment));
  name_ = glCreateProgram();
  glAttachShader(name_, first.name());
  glAttachShader(name_, second.name());
  glLinkProgram(name_);
  GLint done = GL_FALSE;
  glGetProgramiv(name_, GL_LINK_STATUS, &done);
  if (done == GL_TRUE) return;
  std::array<char, 2048> words{};
  glGetProgramInfoLog(name_, static_cast<GLsizei>(words.size()), nullptr, words.data());
  glDeleteProgram(name_);
  throw Error(fmt::format("the OpenGL driver cannot link the shaders of \"{}\": {}", name, words.data()));
}

Program::~Program() { glDeleteProgram(name_); }

void Program::set(const char* uniform, const Vec3d& value) const {
  const auto v = vec_cast<float>(value);
  glUniform3f(place(uniform), v.x, v.y, v.z);
}

void Program::set_turn(const char* uniform, const Vec3d& x, const Vec3d& y, const Vec3d& z) const {
  const Vec3<float> a = vec_cast<float>(x), b = vec_cast<float>(y), c = vec_cast<float>(z);
  const std::array<float, 9> columns{a.x, b.x, c.x, a.y, b.y, c.y, a.z, b.z, c.z};
  glUniformMatrix3fv(place(uniform), 1, GL_FALSE, columns.data());
}

void Program::set_matrix(const char* uniform, const float* columns) const {
  glUniformMatrix4fv(place(uniform), 1, GL_FALSE, columns);
}

void Program::bind(const char* uniform, int unit, GLuint texture, GLenum kind) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(kind, texture);
  set(uniform, unit);
}

Target::Target(int width, int height, std::initializer_list<GLenum> formats, bool depth)
    : width_(width), height_(height) {
  glActiveTexture(GL_TEXTURE0);
  for (const GLenum format : formats) colors_.push_back(make_texture(width, height, format));
  if (depth) depth_.push_back(make_texture(width, height, GL_DEPTH_COMPONENT32F));
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  std::vector<GLenum> places;
  for (const Texture& texture : colors_) {
    places.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(places.size()));
    glFramebufferTexture2D(GL_FRAMEBUFFER, places.back(), GL_TEXTURE_2D, texture.name(), 0);
  }
  if (depth) glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.front().name(), 0);
  if (places.empty()) {
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
  } else {
    glDrawBuffers(static_cast<GLsizei>(places.size()), places.data());
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(fmt::format("the OpenGL driver cannot draw into textures of {} x {} pixels", width, height));
  }
}

void Target::draw_here() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, width_, height_);
}

void filter_smoothly(GLuint texture) {
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void upload(GLenum kind, const Buffer& buffer, const void* data, std::size_t bytes) {
  glBindBuffer(kind, buffer.name());
  glBufferData(kind, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_DRAW);
  if (bytes > 0) glBufferSubData(kind, 0, static_cast<GLsizeiptr>(bytes), data);
}

void check(std::string_view during) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  while (glGetError() != GL_NO_ERROR) {
  }
  throw Error(fmt::format("OpenGL reports {} while {}", error_word(error), during));
}

}  // namespace sessile::draw::gl
