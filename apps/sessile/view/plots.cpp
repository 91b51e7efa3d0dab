#include "view/plots.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sessile::viewer {
namespace {

constexpr ImU32 frame_color = IM_COL32(32, 36, 42, 255), grid_color = IM_COL32(62, 68, 78, 255),
                text_color = IM_COL32(150, 158, 168, 255), line_color = IM_COL32(88, 166, 255, 255),
                now_color = IM_COL32(255, 190, 90, 200);

struct Span {
  double low = 0, high = 1;
  double length() const { return high - low; }
};

/// The ends of the values, never of no length; from 0 when nothing is negative and 0 is near.
Span span_of(const std::vector<double>& values) {
  Span span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    span.low = std::min(span.low, v);
    span.high = std::max(span.high, v);
  }
  if (!(span.low <= span.high)) return {};
  if (span.low > 0 && span.low < 0.7 * span.high) span.low = 0;
  const double least = std::max(1e-3 * std::max(std::abs(span.low), std::abs(span.high)), 1e-12);
  if (span.length() < least) {
    span.high += least;
    if (span.low != 0) span.low -= least;
  }
  span.high += 0.05 * span.length();
  return span;
}

/// Where things lie on the screen.
struct Axes {
  ImVec2 corner, size;  // upper left corner of the field
  Span x, y;

  float across(double value) const { return corner.x + size.x * static_cast<float>((value - x.low) / x.length()); }
  float down(double value) const { return corner.y + size.y * (1 - static_cast<float>((value - y.low) / y.length())); }
};

std::string number(double value, double distance) {
  return fmt::format("{:.4g}", std::abs(value) < 1e-6 * distance ? 0.0 : value);
}

void draw_marks(ImDrawList& draw, const Axes& axes, float letter) {
  const int rows = std::max(3, static_cast<int>(axes.size.y / (1.6F * letter)));
  const int columns = std::max(3, static_cast<int>(axes.size.x / (3.2F * letter)));
  const double dy = mark_distance(axes.y.length(), rows), dx = mark_distance(axes.x.length(), columns);
  for (double y = dy * std::ceil(axes.y.low / dy - 1e-9); y <= axes.y.high; y += dy) {
    const float at = axes.down(y);
    draw.AddLine({axes.corner.x, at}, {axes.corner.x + axes.size.x, at}, grid_color);
    const std::string text = number(y, dy);
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    draw.AddText({axes.corner.x - width - 0.4F * letter, at - 0.5F * letter}, text_color, text.c_str());
  }
  for (double x = dx * std::ceil(axes.x.low / dx - 1e-9); x <= axes.x.high; x += dx) {
    const float at = axes.across(x), bottom = axes.corner.y + axes.size.y;
    draw.AddLine({at, bottom}, {at, bottom + 0.25F * letter}, text_color);
    const std::string text = number(x, dx);
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    const float left = std::min(at - 0.5F * width, axes.corner.x + axes.size.x - width);
    draw.AddText({left, bottom + 0.25F * letter}, text_color, text.c_str());
  }
}

/// A line through all values; of those that share a column of pixels the least and the greatest.
void draw_line(ImDrawList& draw, const Axes& axes, const std::vector<double>& times,
               const std::vector<double>& values) {
  std::vector<ImVec2> line;
  std::size_t k = 0;
  while (k < values.size()) {
    const float at = std::floor(axes.across(times[k]));
    float top = std::numeric_limits<float>::infinity(), bottom = -top, last = 0;
    bool any = false;
    for (; k < values.size() && std::floor(axes.across(times[k])) == at; ++k) {
      if (!std::isfinite(values[k])) continue;
      last = axes.down(values[k]);
      top = std::min(top, last);
      bottom = std::max(bottom, last);
      any = true;
    }
    if (!any) continue;
    if (bottom - top > 1) {
      line.emplace_back(at, last == top ? bottom : top);
    }
    line.emplace_back(at, last);
  }
  draw.AddPolyline(line.data(), static_cast<int>(line.size()), line_color, ImDrawFlags_None, 1.5F);
}

void tell_value(const Axes& axes, const Series& series, const std::vector<double>& times,
                const std::vector<double>& values) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const double time = axes.x.low + axes.x.length() * static_cast<double>((mouse.x - axes.corner.x) / axes.size.x);
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  const auto k = static_cast<std::size_t>(std::min(after - times.begin(), std::ptrdiff_t(times.size()) - 1));
  ImGui::SetTooltip("%s",
                    fmt::format("{} {:.5g} {}\nat {:.5g} s", series.name, values[k], series.unit, times[k]).c_str());
}

}  // namespace

double mark_distance(double length, int most) {
  const double least = length / most;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= least * (1 - 1e-9)) return step * power;
  }
  return 10 * power;
}

void draw_plot(const History& history, std::size_t series, float height, std::optional<double> now) {
  const Series& what = history.series()[series];
  const std::vector<double>&times = history.times(), &values = history.values(series);
  const float letter = ImGui::GetFontSize();
  const std::string unit = what.unit.empty() ? "" : fmt::format(" [{}]", what.unit);
  const std::string last = values.empty() ? "" : fmt::format("{:.4g}", values.back());
  ImGui::TextUnformatted((what.name + unit).c_str());
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(last.c_str()).x);
  ImGui::TextDisabled("%s", last.c_str());

  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::PushID(static_cast<int>(series));
  ImGui::InvisibleButton("plot", {width, height * letter});
  ImGui::PopID();
  const float left = 3.6F * letter, below = 1.4F * letter;
  Axes axes{{corner.x + left, corner.y + 2}, {width - left, height * letter - below - 2}, {}, span_of(values)};
  if (!times.empty()) axes.x = {times.front(), std::max(times.back(), times.front() + 1e-9)};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 end{axes.corner.x + axes.size.x, axes.corner.y + axes.size.y};
  draw.AddRectFilled(axes.corner, end, frame_color, 3);
  if (times.size() < 2) return;
  draw_marks(draw, axes, letter);
  draw.PushClipRect(axes.corner, end, true);
  draw_line(draw, axes, times, values);
  if (now && *now < times.back()) {
    draw.AddLine({axes.across(*now), axes.corner.y}, {axes.across(*now), end.y}, now_color, 1.5F);
  }
  draw.PopClipRect();
  if (ImGui::IsItemHovered()) tell_value(axes, what, times, values);
}

}  // namespace sessile::viewer
