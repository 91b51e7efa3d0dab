#include "view/window.h"

// epoxy before GLFW, which otherwise brings declarations of its own.
#include <epoxy/gl.h>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "draw/ink.h"
#include "say.h"
#include "sessile/core/error.h"
#include "view/theme.h"

namespace sessile::viewer {
namespace {

constexpr float font_pixels = 15;

/// GLFW's last words.
std::string glfw_words() {
  const char* words = nullptr;
  glfwGetError(&words);
  return words == nullptr ? "no reason given" : words;
}

}  // namespace

/// What GLFW calls; it hands back the window.
struct Window::Callbacks {
  static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

  static void key(GLFWwindow* window, int key, int /*scancode*/, int action, int modifiers) {
    Window& self = of(window);
    self.events_ = true;
    if (action == GLFW_RELEASE || (modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0) return;
    const auto wanted = action_of(key);
    // Held keys repeat what one may want many of.
    const bool again = wanted == Action::forward || wanted == Action::backward;
    if (wanted && (action == GLFW_PRESS || again)) self.actions_.push_back(*wanted);
  }
  static void position(GLFWwindow* window, double /*x*/, double /*y*/) { of(window).events_ = true; }
  static void button(GLFWwindow* window, int /*button*/, int /*action*/, int /*modifiers*/) {
    of(window).events_ = true;
  }
  static void scroll(GLFWwindow* window, double /*x*/, double /*y*/) { of(window).events_ = true; }
  static void refresh(GLFWwindow* window) { of(window).events_ = true; }
  static void size(GLFWwindow* window, int /*width*/, int /*height*/) { of(window).events_ = true; }
};

Window::Window(const std::string& title, int width, int height) {
  const char* const way_out = "`sessile picture` makes pictures without a display";
  if (glfwInit() == GLFW_FALSE) throw Error(fmt::format("no window can be opened: {}; {}", glfw_words(), way_out));
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // pictures are made elsewhere and copied
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string words = glfw_words();
    glfwTerminate();
    throw Error(fmt::format("no window with OpenGL 3.3 can be opened: {}; {}", words, way_out));
  }
  glfwSetErrorCallback(
      [](int, const char* words) { app::say(stderr, fmt::format("sessile: the window: {}\n", words)); });
  glfwSetWindowSizeLimits(window_, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  float across = 1, down = 1;
  glfwGetWindowContentScale(window_, &across, &down);
  int units = width;
  glfwGetWindowSize(window_, &units, nullptr);
  density_ = static_cast<float>(this->width()) / static_cast<float>(std::max(1, units));
  const float scale = std::clamp(std::max(across, down) / density_, 0.5F, 4.0F);
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, Callbacks::key);
  glfwSetCursorPosCallback(window_, Callbacks::position);
  glfwSetMouseButtonCallback(window_, Callbacks::button);
  glfwSetScrollCallback(window_, Callbacks::scroll);
  glfwSetWindowRefreshCallback(window_, Callbacks::refresh);
  glfwSetFramebufferSizeCallback(window_, Callbacks::size);

  IMGUI_CHECKVERSION();
  context_ = ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;              // nothing is left in the user's folder
  ImGui::GetIO().ConfigDragClickToInputText = true;  // a click on a number lets one type
  ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
  draw::load_letters(font_pixels * scale);
  set_theme(scale);
  ImGui_ImplGlfw_InitForOpenGL(window_, true);  // calls the callbacks above as well
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Window::~Window() {
  ImGui::SetCurrentContext(context_);  // pictures have contexts of their own
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Window::closing() const { return glfwWindowShouldClose(window_) != GLFW_FALSE; }

void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }

void Window::await(double seconds) {
  if (seconds > 0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
}

std::vector<Action> Window::take_actions() {
  auto actions = std::exchange(actions_, {});
  if (ImGui::GetIO().WantTextInput) actions.clear();
  return actions;
}

bool Window::take_events() { return std::exchange(events_, false); }

int Window::width() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return width;
}

int Window::height() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return height;
}

void Window::begin_frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Window::end_frame() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window_);
}

}  // namespace sessile::viewer
