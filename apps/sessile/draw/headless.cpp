#include "draw/headless.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "sessile/core/error.h"

namespace sessile::draw {
namespace {

constexpr std::string_view remedy =
    "on Debian, apt-get install libegl1 libgl1-mesa-dri brings one that needs no graphics card";

/// Whether a list of extensions, with blanks between them, holds one.
bool holds(const char* list, std::string_view name) {
  const std::string text = list == nullptr ? std::string() : ' ' + std::string(list) + ' ';
  return text.find(fmt::format(" {} ", name)) != std::string::npos;
}

/// Graphics cards that EGL knows, those that are none (software) left out.
std::vector<EGLDeviceEXT> graphics_cards(const char* extensions) {
  if (!holds(extensions, "EGL_EXT_platform_device") || !holds(extensions, "EGL_EXT_device_enumeration")) return {};
  EGLint count = 0;
  if (eglQueryDevicesEXT(0, nullptr, &count) == EGL_FALSE || count <= 0) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (eglQueryDevicesEXT(count, devices.data(), &count) == EGL_FALSE) return {};
  const bool can_tell = holds(extensions, "EGL_EXT_device_query");
  std::erase_if(devices, [&](EGLDeviceEXT device) {
    return can_tell && holds(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
  });
  return devices;
}

/// Every display that may do, the best first: graphics cards, Mesa's without surfaces (a card or software), the
/// default.
std::vector<EGLDisplay> displays() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<EGLDisplay> found;
  if (holds(extensions, "EGL_EXT_platform_base")) {
    for (EGLDeviceEXT device : graphics_cards(extensions)) {
      found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
    if (holds(extensions, "EGL_MESA_platform_surfaceless")) {
      found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    }
  }
  found.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  std::erase(found, EGL_NO_DISPLAY);
  return found;
}

}  // namespace

struct HeadlessContext::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLSurface surface = EGL_NO_SURFACE;
  EGLContext context = EGL_NO_CONTEXT;

  ~Impl() { close(); }

  void close() {
    if (display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
    eglTerminate(display);
    display = EGL_NO_DISPLAY;
    surface = EGL_NO_SURFACE;
    context = EGL_NO_CONTEXT;
  }

  /// Makes a context of that display current. Returns what is in the way, or "".
  std::string open(EGLDisplay on) {
    EGLint major = 0, minor = 0;
    if (eglInitialize(on, &major, &minor) == EGL_FALSE) return "its driver does not start";
    display = on;
    std::string reason = make_current();
    if (!reason.empty()) close();
    return reason;
  }

 private:
  std::string make_current() {
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return "its driver has OpenGL ES only";
    const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                       EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display, wanted.data(), &config, 1, &count) == EGL_FALSE || count == 0) {
      return "its driver has no OpenGL";
    }
    if (!holds(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) {
      const std::array<EGLint, 5> size{EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
      surface = eglCreatePbufferSurface(display, config, size.data());
    }
    const std::array<EGLint, 7> version{
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, version.data());
    if (context == EGL_NO_CONTEXT) return fmt::format("its driver has {}, and 3.3 is needed", version_there_is(config));
    if (eglMakeCurrent(display, surface, surface, context) == EGL_FALSE) return "its driver cannot draw off screen";
    return {};
  }

  /// What a driver without OpenGL 3.3 has instead.
  std::string version_there_is(EGLConfig config) {
    const EGLContext any = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
    if (any == EGL_NO_CONTEXT) return "no OpenGL to speak of";
    std::string text = "an OpenGL of unknown version";
    if (eglMakeCurrent(display, surface, surface, any) == EGL_TRUE) {
      if (const auto* words = reinterpret_cast<const char*>(glGetString(GL_VERSION))) {
        text = fmt::format("OpenGL {}", words);
      }
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(display, any);
    return text;
  }
};

HeadlessContext::HeadlessContext() : impl_(std::make_unique<Impl>()) {
  // Asked for first: epoxy ends the program where it is missing.
  void* library = dlopen("libEGL.so.1", RTLD_LAZY);
  if (library == nullptr) {
    throw Error(fmt::format("cannot draw without a display: there is no libEGL.so.1; {}", remedy));
  }
  dlclose(library);
  std::string reason = "there is no driver";
  for (const EGLDisplay display : displays()) {
    reason = impl_->open(display);
    if (reason.empty()) return;
  }
  throw Error(fmt::format("cannot draw without a display: {}; {}", reason, remedy));
}

HeadlessContext::~HeadlessContext() = default;

}  // namespace sessile::draw
