#pragma once

namespace sessile::viewer {

/// Dark colours and roomy spacing for ImGui's current context; `scale`: pixels of a unit.
void set_theme(float scale);

}  // namespace sessile::viewer
