#include "view/field_editor.h"

#include <fmt/format.h>
#include <imgui.h>

#include <type_traits>

#include "sessile/scene/read_values.h"
#include "sessile/scene/traits.h"
#include "sessile/scene/tuning.h"
#include "sessile/scene/value_text.h"
#include "view/field_widgets.h"
#include "view/widgets.h"

namespace sessile::viewer {
namespace {

/// Walks over declared structs as reading scenes does, and makes a row of a table of each value.
class Editor {
 public:
  explicit Editor(const FieldNotes& notes) : notes_(notes) {}

  template <Declared T>
  bool group(const std::string& path, T& group) {
    bool changed = false;
    for_each_field<T>([&](const auto& f) {
      changed |= value((path.empty() ? "" : path + ".") + std::string(f.key), f, group.*f.member);
    });
    return changed;
  }

 private:
  /// A row: the parameter's name, and room for the field beside it. Colours tell of faults and of what waits.
  template <class F>
  void begin_row(const std::string& path, const F& f, std::string_view name) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::Indent(ImGui::GetTreeNodeToLabelSpacing());
    const bool waits = notes_.pending.contains(path), at_reset = needs_reset(path);
    const bool coloured = notes_.faults.contains(path) || waits;
    if (coloured) ImGui::PushStyleColor(ImGuiCol_Text, notes_.faults.contains(path) ? red : amber);
    ImGui::TextUnformatted((std::string(name) + (at_reset ? " *" : "")).c_str());
    if (coloured) ImGui::PopStyleColor();
    ImGui::Unindent(ImGui::GetTreeNodeToLabelSpacing());
    tooltip(path, f);
    ImGui::TableNextColumn();
    ImGui::PushID(path.c_str());
  }

  bool end_row(const std::string& path, bool changed) {
    ImGui::PopID();
    tell_fault(path);
    return changed;
  }

  void tell_fault(const std::string& path) {
    const auto fault = notes_.faults.find(path);
    if (fault == notes_.faults.end()) return;
    ImGui::PushStyleColor(ImGuiCol_Text, red);
    ImGui::TextWrapped("%s", fault->second.c_str());
    ImGui::PopStyleColor();
  }

  bool needs_reset(const std::string& path) const { return notes_.marks_resets && !may_change_between_steps(path); }

  template <class F>
  void tooltip(const std::string& path, const F& f) {
    if (!ImGui::IsItemHovered()) return;
    std::string text = fmt::format("{}\n\n{}", f.help, path);
    if (!f.unit.empty()) text += fmt::format("\nunit: {}", f.unit);
    if (const std::string range = range_text(f.range, ""); !range.empty()) text += "\nvalues: " + range;
    if (!f.derived.empty()) text += fmt::format("\nnot given: {}", f.derived);
    if (notes_.marks_resets) text += needs_reset(path) ? "\ntakes effect at reset" : "\ntakes effect at once";
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }

  /// A row that opens and closes what stands below it.
  template <class F>
  bool begin_tree(const std::string& path, const F& f, const std::string& name) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    const bool open = ImGui::TreeNodeEx(path.c_str(), ImGuiTreeNodeFlags_SpanAvailWidth, "%s", name.c_str());
    tooltip(path, f);
    ImGui::TableNextColumn();
    return open;
  }

  template <class F, class T>
  bool value(const std::string& path, const F& f, T& value_) {
    if constexpr (is_optional<T>) {
      return optional(path, f, value_);
    } else if constexpr (is_choice<T>) {
      return choice(path, f, std::string(f.key), value_);
    } else if constexpr (Declared<T>) {
      const bool open = begin_tree(path, f, std::string(f.key));
      tell_fault(path);
      const bool changed = open && group(path, value_);
      if (open) ImGui::TreePop();
      return changed;
    } else if constexpr (is_list<T> && is_group<T>) {
      return list(path, f, value_);
    } else {
      begin_row(path, f, f.key);
      ImGui::BeginDisabled(notes_.read_only);
      const bool changed = single(f, value_);
      ImGui::EndDisabled();
      return end_row(path, changed);
    }
  }

  template <class F, class T>
  bool single(const F& f, T& value_) {
    if constexpr (std::is_same_v<T, bool>) {
      return edit_switch(value_);
    } else if constexpr (std::is_same_v<T, int>) {
      return edit_whole_number(value_, f.range);
    } else if constexpr (std::is_same_v<T, double>) {
      return edit_number(value_, f.range, f.unit);
    } else if constexpr (std::is_same_v<T, std::string>) {
      return edit_text(value_);
    } else if constexpr (std::is_same_v<T, Vec3d>) {
      return edit_vector(value_, f.range);
    } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
      return edit_texts(value_);
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      return edit_numbers(value_);
    } else if constexpr (Worded<T>) {
      auto chosen = static_cast<std::size_t>(value_);
      const bool changed = edit_choice(chosen, Words<T>::words);
      value_ = static_cast<T>(chosen);
      return changed;
    } else {
      static_assert(never<T>, "a kind of field that panels cannot show");
    }
  }

  template <class F, class T>
  bool optional(const std::string& path, const F& f, std::optional<T>& value_) {
    begin_row(path, f, f.key);
    bool given = value_.has_value(), changed = false;
    ImGui::BeginDisabled(notes_.read_only);
    if (ImGui::Checkbox("##given", &given)) {
      changed = true;
      if (given) {
        T& fresh = value_.emplace();
        if constexpr (std::is_arithmetic_v<T>) fresh = static_cast<T>(first_value(f.range));
      } else {
        value_.reset();
      }
    }
    ImGui::SameLine();
    if (!value_) {
      ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
      ImGui::TextWrapped("%s", std::string(f.derived).c_str());
      ImGui::PopStyleColor();
    } else if constexpr (!is_group<T>) {
      changed |= single(f, *value_);
    } else {
      ImGui::NewLine();
    }
    ImGui::EndDisabled();
    changed = end_row(path, changed);
    if constexpr (is_group<T>) {
      if (value_) changed |= value(path, f, *value_);
    }
    return changed;
  }

  /// One of several groups: a field to choose, and the chosen one's parameters.
  template <class F, class T>
  bool choice(const std::string& path, const F& f, const std::string& name, T& value_) {
    const bool open = begin_tree(path, f, name + (needs_reset(path + ".type") ? " *" : ""));
    ImGui::PushID(path.c_str());
    const auto names = alternative_names<T>();
    auto chosen = value_.index();
    ImGui::BeginDisabled(notes_.read_only);
    bool changed = edit_choice(chosen, names);
    ImGui::EndDisabled();
    if (changed) {
      std::size_t k = 0;
      for_each_alternative<T>([&]<Named U>(std::type_identity<U>) {
        if (k++ == chosen) value_.template emplace<U>();
      });
    }
    ImGui::PopID();
    tell_fault(path);
    tell_fault(path + ".type");
    if (open) {
      changed |= std::visit([&](auto& each) { return group(path, each); }, value_);
      ImGui::TreePop();
    }
    return changed;
  }

  template <class F, class T>
  bool list(const std::string& path, const F& f, std::vector<T>& values) {
    const bool open =
        begin_tree(path, f, fmt::format("{} ({}){}", f.key, values.size(), needs_reset(path) ? " *" : ""));
    bool changed = false;
    if (button(path, "add")) {
      values.emplace_back();
      changed = true;
    }
    tell_fault(path);
    if (!open) return changed;
    std::optional<std::size_t> dropped;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string place = fmt::format("{}[{}]", path, i);
      if constexpr (is_choice<T>) {
        changed |= choice(place, f, fmt::format("[{}]", i), values[i]);
        if (button(place, "remove")) dropped = i;
      } else {
        const bool entry = begin_tree(place, f, entry_name(values[i], i));
        if (button(place, "remove")) dropped = i;
        tell_fault(place);
        if (entry) changed |= group(place, values[i]);
        if (entry) ImGui::TreePop();
      }
    }
    ImGui::TreePop();
    if (dropped) values.erase(values.begin() + static_cast<std::ptrdiff_t>(*dropped));
    return changed || dropped;
  }

  bool button(const std::string& id, const char* text) const {
    if (notes_.read_only) return false;
    ImGui::PushID(id.c_str());
    const bool pressed = ImGui::SmallButton(text);
    ImGui::PopID();
    return pressed;
  }

  template <class T>
  static std::string entry_name(const T& entry, std::size_t place) {
    if constexpr (requires { entry.label; }) {
      if (!entry.label.empty()) return fmt::format("[{}] {}", place, entry.label);
    }
    return fmt::format("[{}]", place);
  }

  const FieldNotes& notes_;
};

template <class T>
bool edit_table(const char* id, T& group, const FieldNotes& notes) {
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_Resizable |
                                    ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_NoSavedSettings;
  if (!ImGui::BeginTable(id, 2, flags)) return false;
  ImGui::TableSetupColumn("parameter", ImGuiTableColumnFlags_WidthStretch, 0.48F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.52F);
  const bool changed = Editor(notes).group("", group);
  ImGui::EndTable();
  return changed;
}

}  // namespace

bool edit_fields(Scene& scene, const FieldNotes& notes) { return edit_table("scene", scene, notes); }

bool edit_fields(SurfaceSettings& settings, const FieldNotes& notes) { return edit_table("surface", settings, notes); }

}  // namespace sessile::viewer
