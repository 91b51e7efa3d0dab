#pragma once

#include <string>
#include <vector>

#include "view/settings.h"
#include "view/source.h"

namespace sessile::viewer {

/// What the panel shows beside the source and the settings.
struct PanelFacts {
  std::string title;                              ///< of the scene
  draw::Stage stage;                              ///< for the ends of sliders
  std::string field;                              ///< that colours what is shown
  std::string unit;                               ///< its own
  std::pair<float, float> own_range{0.0F, 1.0F};  ///< of its values now
  bool recording = false;
};

/// What was done in the panel.
struct PanelAnswer {
  bool repaint = false;          ///< something is to look different
  bool surface_changed = false;  ///< another surface is wanted
  std::vector<Action> actions;
};

/// Fills ImGui's current window with all there is to set.
PanelAnswer draw_panel(Source& source, Settings& settings, const PanelFacts& facts);

/// A list of keys in the middle of the window; `open` becomes false when it is closed.
void draw_help(bool& open);

}  // namespace sessile::viewer
