#include "view/field_widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace sessile::viewer {
namespace {

// A number above 0 starts so low that it does no harm before one has typed another.
constexpr double small_value = 1e-3;

/// A pixel of dragging, as a share of the value or of its range.
float drag_speed(double value, Range range) {
  if (std::isfinite(range.low) && std::isfinite(range.high)) return static_cast<float>(2e-3 * (range.high - range.low));
  return value == 0 ? 0.01F : static_cast<float>(5e-3 * std::abs(value));
}

/// The parts of a text between commas, without blanks around them.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  std::string part;
  const auto end = [&] {
    const auto first = part.find_first_not_of(' ');
    if (first != std::string::npos) parts.push_back(part.substr(first, part.find_last_not_of(' ') - first + 1));
    part.clear();
  };
  for (const char c : text) {
    if (c == ',') {
      end();
    } else {
      part += c;
    }
  }
  end();
  return parts;
}

bool edit_component(const char* id, double& value, Range range, const char* format) {
  const double low = range.low, high = range.high;
  const bool bounded = std::isfinite(low) || std::isfinite(high);
  double wanted = value;
  if (!ImGui::DragScalar(id, ImGuiDataType_Double, &wanted, drag_speed(value, range), bounded ? &low : nullptr,
                         bounded ? &high : nullptr, format)) {
    return false;
  }
  // Dragging stays within the range; what is typed beyond it is told of.
  if (ImGui::IsMouseDragging(ImGuiMouseButton_Left) && !range.holds(wanted)) return false;
  const bool changed = wanted != value;
  value = wanted;
  return changed;
}

/// Shows a number with its unit behind it.
std::string number_format(std::string_view unit) {
  const bool short_unit = !unit.empty() && unit.size() < 10;
  return short_unit ? fmt::format("%.6g {}", unit) : "%.6g";
}

}  // namespace

double first_value(Range range) {
  if (range.holds(0)) return 0;
  if (range.above && range.holds(range.low + small_value)) return range.low + small_value;
  return range.low;
}

bool edit_number(double& value, Range range, std::string_view unit) {
  ImGui::SetNextItemWidth(-FLT_MIN);
  return edit_component("##number", value, range, number_format(unit).c_str());
}

bool edit_whole_number(int& value, Range range) {
  ImGui::SetNextItemWidth(-FLT_MIN);
  const int low = range.low > -1e9 ? static_cast<int>(range.low) : -1000000000;
  const int high = range.high < 1e9 ? static_cast<int>(range.high) : 1000000000;
  return ImGui::DragInt("##whole", &value, 0.2F, low, high);
}

bool edit_vector(Vec3d& value, Range range) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  bool changed = false;
  std::array<double*, 3> parts{&value.x, &value.y, &value.z};
  for (std::size_t k = 0; k < 3; ++k) {
    ImGui::PushID(static_cast<int>(k));
    if (k > 0) ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(width);
    changed |= edit_component("##part", *parts[k], range, "%.4g");
    ImGui::PopID();
  }
  return changed;
}

bool edit_switch(bool& value) { return ImGui::Checkbox("##switch", &value); }

bool edit_text(std::string& value) {
  ImGui::SetNextItemWidth(-FLT_MIN);
  return ImGui::InputText("##text", &value);
}

bool edit_texts(std::vector<std::string>& values) {
  std::string text = fmt::format("{}", fmt::join(values, ", "));
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (!ImGui::InputText("##texts", &text, ImGuiInputTextFlags_EnterReturnsTrue)) return false;
  values = parts_of(text);
  return true;
}

bool edit_numbers(std::vector<double>& values) {
  std::string text = fmt::format("{}", fmt::join(values, ", "));
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (!ImGui::InputText("##numbers", &text, ImGuiInputTextFlags_EnterReturnsTrue)) return false;
  std::vector<double> numbers;
  for (const std::string& part : parts_of(text)) {
    double number = 0;
    if (std::from_chars(part.data(), part.data() + part.size(), number).ec != std::errc{}) return false;
    numbers.push_back(number);
  }
  values = std::move(numbers);
  return true;
}

bool edit_choice(std::size_t& chosen, std::span<const std::string_view> words) {
  bool changed = false;
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (!ImGui::BeginCombo("##choice", std::string(words[chosen]).c_str())) return false;
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (ImGui::Selectable(std::string(words[k]).c_str(), k == chosen) && k != chosen) {
      chosen = k;
      changed = true;
    }
    if (k == chosen) ImGui::SetItemDefaultFocus();
  }
  ImGui::EndCombo();
  return changed;
}

}  // namespace sessile::viewer
