#pragma once

#include <string>
#include <vector>

#include "view/keys.h"

struct GLFWwindow;
struct ImGuiContext;

namespace sessile::viewer {

/// A place in the window in its framebuffer [pixels], y from the top.
struct Region {
  int x = 0, y = 0, width = 0, height = 0;
  friend bool operator==(const Region&, const Region&) = default;
};

/// A window with OpenGL 3.3 core and Dear ImGui in it.
class Window {
 public:
  /// Throws Error when there is no display, or no OpenGL of that age.
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  bool closing() const;
  void close();

  /// Looks at what the user did. When nothing moves, sleeps until something happens, at most `seconds`.
  void await(double seconds);

  /// Keys pressed since one last asked, but for those typed into a field.
  std::vector<Action> take_actions();

  /// Whether anything came from the user or the system since one last asked.
  bool take_events();

  int width() const;                          ///< of the framebuffer [pixels]
  int height() const;                         ///< of the framebuffer [pixels]
  float density() const { return density_; }  ///< pixels of a unit of the interface

  void begin_frame();
  void end_frame();  ///< draws the interface over what stands in the framebuffer, and shows both

 private:
  struct Callbacks;

  GLFWwindow* window_ = nullptr;
  ImGuiContext* context_ = nullptr;
  float density_ = 1;
  std::vector<Action> actions_;
  bool events_ = true;
};

}  // namespace sessile::viewer
