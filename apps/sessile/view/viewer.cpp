#include "view/viewer.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "draw/legend.h"
#include "view/camera_control.h"
#include "view/widgets.h"

namespace sessile::viewer {
namespace {

constexpr double frame_time = 1.0 / 60;  // where the display does not set the pace [s]
constexpr double quick_frame = 0.03;     // after a frame that took no longer the next may follow at once [s]
constexpr double slow_frame = 0.1, coarse_gain = 3;  // [s]; how much longer a whole picture takes
constexpr double calm_time = 0.3;                    // without a change, after which a coarse picture is made whole [s]
constexpr double idle_time = 0.25;                   // between looks when nothing moves [s]
constexpr double notice_time = 6;                    // [s]
constexpr float panel_letters = 25, least_panel_letters = 14;  // width of the panel

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Viewer::Viewer(Window& window, Source& source, Settings settings, ViewerOptions options)
    : window_(window),
      source_(source),
      settings_(std::move(settings)),
      options_(std::move(options)),
      capture_(options_.folder, options_.name),
      stage_(source.stage()),
      canvas_(stage_) {
  settings_.camera.up = stage_.up;
  if (!settings_.field.empty()) source_.colour_by(settings_.field);
  set_look(settings_.appearance.look);
}

void Viewer::run() {
  while (!window_.closing()) {
    window_.await(rest());
    if (!worth_drawing()) continue;
    draw_frame();
    if (options_.frames > 0 && ++drawn_ >= options_.frames) window_.close();
  }
  if (capture_.recording()) capture_.finish();
}

/// How long to sleep when nothing comes from the user.
double Viewer::rest() const {
  const double since = seconds_since(last_);
  if (options_.frames > 0) return 0;
  const bool busy = source_.moves() || capture_.recording() || restless_ > 0 || owed_;
  return busy ? std::max(frame_time - since, 1e-4) : idle_time;
}

/// Takes in what has come; whether the window would look any different.
bool Viewer::worth_drawing() {
  if (source_.update()) {
    stage_ = source_.stage();
    settings_.camera.up = stage_.up;
    canvas_.set_stage(stage_);
    dirty_ = true;
  }
  if (auto moment = source_.take_moment()) {
    canvas_.show(*std::move(moment));
    dirty_ = fresh_ = true;
  }
  if (window_.take_events()) restless_ = 3;
  const bool notice_ends = !notice_.empty() && Clock::now() > notice_end_;
  if (notice_ends) notice_.clear();
  // Where drawing takes long, on processors that step the liquid as well, half of the time is left to the steps.
  const bool rested = seconds_since(shown_) >= cost_ - quick_frame;
  const bool sharpen = owed_ && seconds_since(stirred_) > calm_time;
  const bool worth = (dirty_ && rested) || sharpen || restless_ > 0 || notice_ends || capture_.due() ||
                     options_.frames > 0 || ImGui::GetIO().WantTextInput;  // its cursor blinks
  if (restless_ > 0) --restless_;
  return worth;
}

void Viewer::draw_frame() {
  const double passed = seconds_since(last_);
  last_ = Clock::now();
  frames_per_second_ += std::min(1.0, passed / 0.5) * (1 / std::max(passed, 1e-6) - frames_per_second_);
  window_.begin_frame();
  draw_interface();
  for (const Action action : window_.take_actions()) act(action);
  const Region region = picture();
  if (follow_mouse(settings_.camera, static_cast<float>(std::max(1, region.height)))) dirty_ = true;
  paint();
  canvas_.copy_to(region, window_.height());
  window_.end_frame();
  shown_ = Clock::now();
  cost_ = seconds_since(last_);
  if (std::exchange(painted_, false)) slow_ = (owed_ ? coarse_gain : 1) * cost_ > slow_frame;
  if (capture_.recording()) film(std::exchange(fresh_, false));
}

/// Where the picture stands: what panel and status line leave.
Region Viewer::picture() const {
  const auto pixels = [&](float units) { return static_cast<int>(std::lround(units * window_.density())); };
  const int left = settings_.panel ? pixels(panel_width_) : 0;
  return {left, 0, std::max(1, window_.width() - left), std::max(1, window_.height() - pixels(status_height_))};
}

/// Paints what has changed: coarsely where that takes long, and wholly once things are calm, or when asked to.
void Viewer::paint(bool whole) {
  const Region region = picture();
  if (region.width != canvas_.width() || region.height != canvas_.height()) dirty_ = true;
  if (dirty_) stirred_ = Clock::now();
  const bool calm = seconds_since(stirred_) > calm_time;
  if (!dirty_ && !(owed_ && (whole || calm))) return;
  owed_ = dirty_ && slow_ && !whole && !capture_.recording();
  painted_ = true;
  dirty_ = false;
  if (!fitted_) fit(false);
  fitted_ = true;
  draw::Appearance appearance = settings_.appearance;
  if (settings_.fixed_range) appearance.range = std::pair{settings_.low, settings_.high};
  if (settings_.clipped) appearance.clip = settings_.plane;
  canvas_.paint(settings_.camera, appearance, region.width, region.height, owed_);
}

void Viewer::draw_interface() {
  const float letter = ImGui::GetFontSize();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  status_height_ = 1.9F * letter;
  draw_status();
  if (settings_.panel) {
    const float height = size.y - status_height_;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({std::min(panel_letters * letter, 0.6F * size.x), height}, ImGuiCond_Once);
    ImGui::SetNextWindowSizeConstraints({least_panel_letters * letter, height},
                                        {std::max(least_panel_letters * letter, 0.8F * size.x), height});
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoTitleBar |
                                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoBringToFrontOnFocus;
    PanelAnswer answer;
    if (ImGui::Begin("panel", nullptr, flags)) {
      const draw::Moment& moment = canvas_.moment();
      answer =
          draw_panel(source_, settings_,
                     {options_.name, stage_, moment.field, moment.unit, draw::own_range(moment), capture_.recording()});
    }
    panel_width_ = ImGui::GetWindowWidth();
    ImGui::End();
    dirty_ |= answer.repaint;
    if (answer.surface_changed) source_.want_surface(settings_.surface);
    for (const Action action : answer.actions) act(action);
  }
  if (settings_.help) draw_help(settings_.help);
  draw_notice();
}

void Viewer::draw_status() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, size.y - status_height_});
  ImGui::SetNextWindowSize({size.x, status_height_});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.7F * ImGui::GetFontSize(), 0.4F * ImGui::GetFontSize()});
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin("status", nullptr, flags)) {
    ImGui::TextUnformatted(source_.status().c_str());
    const std::string rate = source_.moves() ? fmt::format("{:.3g} frames/s   ", frames_per_second_) : "";
    const std::string right = rate + "H: keys";
    const float place = size.x - ImGui::CalcTextSize(right.c_str()).x - 0.7F * ImGui::GetFontSize();
    ImGui::SameLine();
    if (ImGui::GetCursorPosX() < place) {
      ImGui::SetCursorPosX(place);
      ImGui::TextDisabled("%s", right.c_str());
    }
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

void Viewer::draw_notice() {
  std::string text = notice_;
  if (capture_.recording() && text.empty()) text = "recording; V ends it";
  if (const std::string fault = source_.fault(); !fault.empty()) text = fault;
  if (text.empty()) return;
  const Region region = picture();
  const float letter = ImGui::GetFontSize();
  const float left = static_cast<float>(region.x) / window_.density();
  const float width = static_cast<float>(region.width) / window_.density();
  ImGui::SetNextWindowPos({left + 0.5F * width, 2.6F * letter}, ImGuiCond_Always, {0.5F, 0});
  ImGui::SetNextWindowBgAlpha(0.85F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.5F * letter);
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                     ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin("notice", nullptr, flags)) {
    ImGui::PushTextWrapPos(std::max(20 * letter, 0.8F * width));
    if (!source_.fault().empty()) {
      ImGui::TextColored(red, "%s", text.c_str());
    } else {
      ImGui::TextUnformatted(text.c_str());
    }
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

/// Adds to the video what is due: each moment of results once, what is shown of a simulation at equal times.
void Viewer::film(bool fresh) {
  const bool by_moment = source_.video_by_moment();
  if (by_moment ? !fresh : !capture_.due()) return;
  try {
    if (!capture_.add(canvas_.image(), by_moment)) {
      say(fmt::format("the picture has another size now: {}", capture_.finish()));
    }
  } catch (const std::exception& e) {
    say(e.what());
  }
}

void Viewer::say(std::string text) {
  notice_ = std::move(text);
  notice_end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(notice_time));
  restless_ = 3;
}

}  // namespace sessile::viewer
