#pragma once

#include <imgui.h>

#include <string>

/// Small things that panels share.
namespace sessile::viewer {

inline const ImVec4 amber(1.0F, 0.74F, 0.30F, 1.0F), red(1.0F, 0.45F, 0.42F, 1.0F);

/// A button that takes one of `count` equal shares of the panel's width.
bool wide_button(const char* text, int count, int place);

/// Text beside the pointer, over the last item.
void tooltip(const char* text);

}  // namespace sessile::viewer
