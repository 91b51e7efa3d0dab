#include "view/panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <tuple>
#include <utility>

#include "view/field_editor.h"
#include "view/plots.h"
#include "view/widgets.h"

namespace sessile::viewer {
namespace {

constexpr float plot_height = 6.5F;  // in letters

void draw_look(Settings& settings, PanelAnswer& answer) {
  auto look = static_cast<int>(settings.appearance.look);
  for (const auto& [text, value] : {std::pair{"particles", 0}, std::pair{"liquid", 1}, std::pair{"surface", 2}}) {
    if (value > 0) ImGui::SameLine();
    if (ImGui::RadioButton(text, &look, value)) {
      answer.actions.push_back(
          std::array{Action::particles, Action::liquid, Action::surface}[static_cast<std::size_t>(value)]);
    }
  }
  if (settings.appearance.look == draw::Look::surface && ImGui::TreeNode("surface settings")) {
    if (edit_fields(settings.surface, {})) answer.surface_changed = true;
    ImGui::TreePop();
  }
}

void draw_colours(Source& source, Settings& settings, const PanelFacts& facts, PanelAnswer& answer) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("colour");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::BeginCombo("##field", facts.field.c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const std::string& field : source.fields()) {
      if (ImGui::Selectable(field.c_str(), field == facts.field)) {
        settings.field = field;
        settings.fixed_range = false;
        source.colour_by(field);
        answer.repaint = true;
      }
    }
    ImGui::EndCombo();
  }
  if (ImGui::Checkbox("fixed range", &settings.fixed_range)) {
    if (settings.fixed_range) std::tie(settings.low, settings.high) = facts.own_range;
    answer.repaint = true;
  }
  tooltip("Off: the colours span the values of each moment.");
  if (!settings.fixed_range) return;
  ImGui::SameLine();
  std::array<float, 2> ends{settings.low, settings.high};
  ImGui::SetNextItemWidth(-FLT_MIN);
  const float speed = std::max(1e-6F, 5e-3F * (settings.high - settings.low));
  if (ImGui::DragFloatRange2("##range", &ends[0], &ends[1], speed, 0, 0, "%.4g", "%.4g") && ends[1] > ends[0]) {
    settings.low = ends[0];
    settings.high = ends[1];
    answer.repaint = true;
  }
}

void draw_clip(Settings& settings, const draw::Stage& stage, PanelAnswer& answer) {
  if (ImGui::Checkbox("cut open", &settings.clipped)) answer.repaint = true;
  if (!settings.clipped) return;
  Vec3d& normal = settings.plane.normal;
  const auto choose = [&](const char* text, const Vec3d& axis) {
    ImGui::SameLine();
    const bool chosen = normal == axis || normal == -axis;
    if (ImGui::RadioButton(text, chosen) && !chosen) {
      normal = axis;
      settings.plane.offset = dot(axis, 0.5 * (stage.low + stage.high));
      answer.repaint = true;
    }
  };
  choose("x", {1, 0, 0});
  choose("y", {0, 1, 0});
  choose("z", {0, 0, 1});
  ImGui::SameLine();
  if (ImGui::SmallButton("flip")) {
    normal = -normal;
    settings.plane.offset = -settings.plane.offset;
    answer.repaint = true;
  }
  const double a = dot(normal, stage.low), b = dot(normal, stage.high), low = std::min(a, b), high = std::max(a, b);
  ImGui::SetNextItemWidth(-FLT_MIN);
  answer.repaint |=
      ImGui::SliderScalar("##offset", ImGuiDataType_Double, &settings.plane.offset, &low, &high, "at %.4g m");
}

void draw_view(Source& source, Settings& settings, const PanelFacts& facts, PanelAnswer& answer) {
  draw_look(settings, answer);
  draw_colours(source, settings, facts, answer);
  draw_clip(settings, facts.stage, answer);
  answer.repaint |= ImGui::Checkbox("solids", &settings.appearance.solids);
  ImGui::SameLine();
  answer.repaint |= ImGui::Checkbox("ground", &settings.appearance.ground);
  ImGui::SameLine();
  answer.repaint |= ImGui::Checkbox("legend", &settings.appearance.legend);
  bool fine = settings.appearance.fineness > 1;
  ImGui::SameLine();
  if (ImGui::Checkbox("fine", &fine)) {
    settings.appearance.fineness = fine ? 2 : 1;
    answer.repaint = true;
  }
  tooltip("Four rays a pixel: smoother edges, and four times the work.");
  const auto button = [&](const char* text, int place, Action action, const char* help) {
    if (place > 0) ImGui::SameLine();
    if (wide_button(text, 5, place)) answer.actions.push_back(action);
    tooltip(help);
  };
  button("Fit", 0, Action::fit, "All of the liquid in the picture (F)");
  button("X", 1, Action::along_x, "Look along x (X)");
  button("Y", 2, Action::along_y, "Look along y (Y)");
  button("Z", 3, Action::along_z, "Look along z (Z)");
  button(settings.camera.orthographic ? "Persp." : "Ortho", 4, Action::orthographic, "Orthographic or perspective (O)");
  if (wide_button("Save picture", 2, 0)) answer.actions.push_back(Action::still);
  tooltip("PNG of what is shown, without the panel (P, F12)");
  ImGui::SameLine();
  if (facts.recording) ImGui::PushStyleColor(ImGuiCol_Button, {0.65F, 0.18F, 0.16F, 1});
  if (wide_button(facts.recording ? "Stop video" : "Record video", 2, 1)) answer.actions.push_back(Action::video);
  if (facts.recording) ImGui::PopStyleColor();
  tooltip("MP4 of what is shown, by ffmpeg (V)");
}

void draw_plots(const Source& source) {
  const History& history = source.history();
  if (history.times().size() < 2) {
    ImGui::TextDisabled("Nothing yet: no step was made, or stats.csv holds no lines.");
    return;
  }
  for (std::size_t k = 0; k < history.series().size(); ++k) draw_plot(history, k, plot_height, source.time());
  ImGui::TextDisabled("over simulated time [s]");
}

}  // namespace

PanelAnswer draw_panel(Source& source, Settings& settings, const PanelFacts& facts) {
  PanelAnswer answer;
  ImGui::PushTextWrapPos();
  ImGui::TextUnformatted(facts.title.c_str());
  ImGui::PopTextWrapPos();
  if (const std::string fault = source.fault(); !fault.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, red);
    ImGui::TextWrapped("%s", fault.c_str());
    ImGui::PopStyleColor();
  }
  ImGui::Separator();
  source.draw_controls();
  ImGui::Separator();
  if (ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen)) draw_view(source, settings, facts, answer);
  if (ImGui::CollapsingHeader("Parameters", ImGuiTreeNodeFlags_DefaultOpen)) source.draw_parameters();
  if (ImGui::CollapsingHeader("Plots", ImGuiTreeNodeFlags_DefaultOpen)) draw_plots(source);
  return answer;
}

void draw_help(bool& open) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5F * size.x, 0.5F * size.y}, ImGuiCond_Always, {0.5F, 0.5F});
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                     ImGuiWindowFlags_AlwaysAutoResize;
  if (ImGui::Begin("Keys and mouse", &open, flags) && ImGui::BeginTable("keys", 2)) {
    const auto row = [](std::string_view left, std::string_view right) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextColored(amber, "%s", std::string(left).c_str());
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(std::string(right).c_str());
    };
    for (const Binding& each : bindings()) row(each.keys, each.help);
    row("", "");
    for (const Gesture& each : gestures()) row(each.gesture, each.help);
    row("Click on a number", "type one; a drag changes it");
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace sessile::viewer
