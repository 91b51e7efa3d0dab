#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sessile::viewer {

/// What a key can ask for.
enum class Action {
  play,
  forward,
  backward,
  reset,
  fit,
  particles,
  liquid,
  surface,
  along_x,
  along_y,
  along_z,
  orthographic,
  clip,
  legend,
  still,
  video,
  panel,
  help,
  quit
};

/// Something that keys do, for people.
struct Binding {
  Action action;
  std::string_view keys;  ///< as printed on them: "Space", "F, Home"
  std::string_view help;
};

std::span<const Binding> bindings();

/// The mouse, for people: what one does, and what comes of it.
struct Gesture {
  std::string_view gesture, help;
};
std::span<const Gesture> gestures();

/// What a key of GLFW asks for.
std::optional<Action> action_of(int glfw_key);

/// Keys and mouse as lines for `--help`.
std::string keys_text();

}  // namespace sessile::viewer
