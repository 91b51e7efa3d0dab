#include "view/widgets.h"

namespace sessile::viewer {

bool wide_button(const char* text, int count, int place) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float all = ImGui::GetWindowContentRegionMax().x - ImGui::GetWindowContentRegionMin().x;
  const auto shares = static_cast<float>(count);
  const float width = (all - gap * (shares - 1)) / shares;
  return ImGui::Button(text, {place == count - 1 ? -FLT_MIN : width, 0});
}

void tooltip(const char* text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace sessile::viewer
