#include "view/keys.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace sessile::viewer {
namespace {

struct Key {
  int key;
  Action action;
};

constexpr auto keys = std::to_array<Key>({
    {GLFW_KEY_SPACE, Action::play},    {GLFW_KEY_RIGHT, Action::forward},  {GLFW_KEY_PERIOD, Action::forward},
    {GLFW_KEY_LEFT, Action::backward}, {GLFW_KEY_COMMA, Action::backward}, {GLFW_KEY_R, Action::reset},
    {GLFW_KEY_F, Action::fit},         {GLFW_KEY_HOME, Action::fit},       {GLFW_KEY_1, Action::particles},
    {GLFW_KEY_2, Action::liquid},      {GLFW_KEY_3, Action::surface},      {GLFW_KEY_X, Action::along_x},
    {GLFW_KEY_Y, Action::along_y},     {GLFW_KEY_Z, Action::along_z},      {GLFW_KEY_O, Action::orthographic},
    {GLFW_KEY_C, Action::clip},        {GLFW_KEY_L, Action::legend},       {GLFW_KEY_P, Action::still},
    {GLFW_KEY_F12, Action::still},     {GLFW_KEY_V, Action::video},        {GLFW_KEY_TAB, Action::panel},
    {GLFW_KEY_H, Action::help},        {GLFW_KEY_F1, Action::help},        {GLFW_KEY_Q, Action::quit},
    {GLFW_KEY_ESCAPE, Action::quit},
});

constexpr auto bound = std::to_array<Binding>({
    {Action::play, "Space", "play or pause"},
    {Action::forward, "Right, period", "one step of a simulation, one frame of results"},
    {Action::backward, "Left, comma", "one frame of results back"},
    {Action::reset, "R", "from the start, with the parameters of the panel"},
    {Action::fit, "F, Home", "all of the liquid in the picture"},
    {Action::particles, "1", "show particles"},
    {Action::liquid, "2", "show a smoothed liquid"},
    {Action::surface, "3", "show the reconstructed surface"},
    {Action::along_x, "X", "look along x; once more: from the other side"},
    {Action::along_y, "Y", "look along y"},
    {Action::along_z, "Z", "look along z"},
    {Action::orthographic, "O", "orthographic or perspective"},
    {Action::clip, "C", "cut the picture open, or close it"},
    {Action::legend, "L", "legend on or off"},
    {Action::still, "P, F12", "save a picture"},
    {Action::video, "V", "start or stop a video"},
    {Action::panel, "Tab", "panel on or off"},
    {Action::help, "H, F1", "this list"},
    {Action::quit, "Q, Esc", "close the window"},
});

constexpr auto mouse = std::to_array<Gesture>({
    {"drag", "turn around the liquid"},
    {"Shift drag, middle drag", "move the picture"},
    {"wheel, right drag", "nearer or farther"},
});

}  // namespace

std::span<const Binding> bindings() { return bound; }

std::span<const Gesture> gestures() { return mouse; }

std::optional<Action> action_of(int glfw_key) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& each) { return each.key == glfw_key; });
  if (found == keys.end()) return {};
  return found->action;
}

std::string keys_text() {
  std::string text = "Keys:\n";
  for (const Binding& each : bound) text += fmt::format("  {:24} {}\n", each.keys, each.help);
  text += "Mouse:\n";
  for (const Gesture& each : mouse) text += fmt::format("  {:24} {}\n", each.gesture, each.help);
  return text;
}

}  // namespace sessile::viewer
