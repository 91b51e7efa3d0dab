#pragma once

#include <functional>
#include <memory>

struct ImFont;

namespace sessile::draw {

/// Size of letters in a picture of that height [pixels].
float letter_size(float height);

/// Loads a plain sans-serif of that size [pixels] into the current Dear ImGui context, or that library's own when the
/// system has none of those looked for. To be called before the context's first frame.
ImFont* load_letters(float pixels);

/// Writes and draws on pictures by Dear ImGui where there is no window. Needs a current OpenGL context for all it does.
class Ink {
 public:
  /// For pictures of that size [pixels].
  Ink(int width, int height);
  ~Ink();
  Ink(const Ink&) = delete;
  Ink& operator=(const Ink&) = delete;

  /// Draws over a framebuffer what `content` puts into Dear ImGui's draw lists.
  void draw(unsigned framebuffer, const std::function<void()>& content);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sessile::draw
