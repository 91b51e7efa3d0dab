#include "view/theme.h"

#include <imgui.h>

namespace sessile::viewer {

void set_theme(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0;
  style.FrameRounding = 4;
  style.GrabRounding = 4;
  style.PopupRounding = 6;
  style.ScrollbarRounding = 6;
  style.WindowBorderSize = 0;
  style.WindowPadding = {12, 10};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 6};
  style.IndentSpacing = 14;
  style.ScrollbarSize = 12;
  ImVec4* const colors = style.Colors;
  const ImVec4 accent{0.27F, 0.60F, 0.92F, 1.0F};
  const auto tinted = [&](float alpha) { return ImVec4{accent.x, accent.y, accent.z, alpha}; };
  colors[ImGuiCol_Text] = {0.90F, 0.92F, 0.94F, 1};
  colors[ImGuiCol_TextDisabled] = {0.56F, 0.60F, 0.64F, 1};
  colors[ImGuiCol_WindowBg] = {0.105F, 0.115F, 0.13F, 1};
  colors[ImGuiCol_PopupBg] = {0.13F, 0.145F, 0.165F, 0.98F};
  colors[ImGuiCol_FrameBg] = {0.175F, 0.19F, 0.215F, 1};
  colors[ImGuiCol_FrameBgHovered] = {0.22F, 0.245F, 0.28F, 1};
  colors[ImGuiCol_FrameBgActive] = {0.25F, 0.28F, 0.32F, 1};
  colors[ImGuiCol_Button] = {0.20F, 0.225F, 0.255F, 1};
  colors[ImGuiCol_ButtonHovered] = tinted(0.55F);
  colors[ImGuiCol_ButtonActive] = tinted(0.85F);
  colors[ImGuiCol_Header] = {0.165F, 0.18F, 0.205F, 1};
  colors[ImGuiCol_HeaderHovered] = tinted(0.35F);
  colors[ImGuiCol_HeaderActive] = tinted(0.5F);
  colors[ImGuiCol_CheckMark] = accent;
  colors[ImGuiCol_SliderGrab] = accent;
  colors[ImGuiCol_SliderGrabActive] = tinted(0.8F);
  colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = {0.165F, 0.18F, 0.205F, 1};
  colors[ImGuiCol_ResizeGrip] = tinted(0.15F);
  colors[ImGuiCol_Separator] = {0.24F, 0.265F, 0.30F, 1};
  style.ScaleAllSizes(scale);
}

}  // namespace sessile::viewer
