#include "draw/legend.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "draw/color_map.h"
#include "draw/ink.h"

namespace sessile::draw {
namespace {

constexpr ImU32 ink = IM_COL32(38, 44, 52, 255);
constexpr ImU32 halo = IM_COL32(255, 255, 255, 110);

/// Letters with a pale rim, readable on whatever lies below.
class Writer {
 public:
  explicit Writer(float size) : size_(size) {}

  ImVec2 extent(const std::string& text) const { return font_->CalcTextSizeA(size_, 1e9F, 0, text.c_str()); }

  /// `anchor` 0 puts the text right of the place, 0.5 in its middle, 1 left of it.
  void write(const std::string& text, float x, float y, float anchor) const {
    const ImVec2 at{std::round(x - anchor * extent(text).x), std::round(y)};
    for (const float dx : {-1.0F, 0.0F, 1.0F}) {
      for (const float dy : {-1.0F, 0.0F, 1.0F}) {
        if (dx != 0 || dy != 0) list_->AddText(font_, size_, {at.x + dx, at.y + dy}, halo, text.c_str());
      }
    }
    list_->AddText(font_, size_, at, ink, text.c_str());
  }

 private:
  ImDrawList* list_ = ImGui::GetBackgroundDrawList();
  ImFont* font_ = ImGui::GetFont();
  float size_;
};

/// Round numbers between both ends, three to six of them.
std::vector<double> ticks(double low, double high) {
  const double rough = (high - low) / 4;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = power;
  for (const double factor : {1.0, 2.0, 2.5, 5.0, 10.0}) {
    step = factor * power;
    if (step >= 0.999 * rough) break;
  }
  std::vector<double> places;
  for (double k = std::ceil(low / step - 1e-6); k * step <= high + 1e-6 * step; ++k) places.push_back(k * step);
  return places;
}

void draw_bar(ImDrawList& list, float left, float top, float width, float height) {
  constexpr int parts = 64;
  const std::vector<Rgb> colors = color_map(parts + 1);
  const auto color = [&](int k) {
    const Rgb& c = colors[static_cast<std::size_t>(k)];
    return ImGui::ColorConvertFloat4ToU32(
        {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]), 1});
  };
  for (int k = 0; k < parts; ++k) {
    const float x0 = left + width * static_cast<float>(k) / parts,
                x1 = left + width * static_cast<float>(k + 1) / parts;
    list.AddRectFilledMultiColor({x0, top}, {x1, top + height}, color(k), color(k + 1), color(k + 1), color(k));
  }
  list.AddRect({left - 0.5F, top - 0.5F}, {left + width + 0.5F, top + height + 0.5F}, IM_COL32(38, 44, 52, 140));
}

}  // namespace

float legend_share() { return 0.15F; }

void draw_time(const Moment& moment, float left, float height) {
  const float letters = letter_size(height);
  Writer(letters).write(fmt::format("t = {:.{}f} s", moment.time, moment.time_decimals), left + 0.9F * letters,
                        0.6F * letters, 0);
}

void draw_color_bar(const Moment& moment, const Appearance& appearance, std::pair<float, float> range, float width,
                    float height) {
  if (appearance.look != Look::particles || moment.field.empty()) return;
  const float letters = letter_size(height), margin = 0.9F * letters;
  const Writer writer(letters);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float bar = std::round(std::max(0.26F * width, 9 * letters)), thick = std::round(0.62F * letters);
  const float left = std::round(0.5F * (width - bar));
  const float top = std::round(height - 0.4F * margin - 1.25F * letters - thick);
  const std::string name = moment.unit.empty() ? moment.field : fmt::format("{} [{}]", moment.field, moment.unit);
  writer.write(name, left + 0.5F * bar, top - 1.35F * letters, 0.5F);
  draw_bar(list, left, top, bar, thick);
  const auto [low, high] = range;
  float free_from = -1e9F;  // where the last label ends
  for (const double value : ticks(low, high)) {
    const float x = left + bar * static_cast<float>((value - low) / (static_cast<double>(high) - low));
    list.AddLine({x, top + thick}, {x, top + thick + 0.25F * letters}, ink);
    const std::string label = fmt::format("{:.4g}", value == 0 ? 0 : value);
    const float half = 0.5F * writer.extent(label).x;
    if (x - half < free_from) continue;
    writer.write(label, x, top + thick + 0.25F * letters, 0.5F);
    free_from = x + half + 0.5F * letters;
  }
}

void draw_legend(const Moment& moment, const Appearance& appearance, std::pair<float, float> range, float width,
                 float height) {
  if (!appearance.legend) return;
  draw_time(moment, 0, height);
  draw_color_bar(moment, appearance, range, width, height);
}

}  // namespace sessile::draw
