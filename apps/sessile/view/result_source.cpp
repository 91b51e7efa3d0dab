#include "view/result_source.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "compare/outcome.h"
#include "shown.h"
#include "view/widgets.h"

namespace sessile::viewer {
namespace {

/// A quantity of stats.csv, and how the plots call it.
struct Followed {
  const char* title;
  const char* column;
  const char* unit;
  double factor;
};

constexpr auto followed = std::to_array<Followed>({
    {"kinetic energy", "kinetic_energy [J]", "J", 1},
    {"greatest speed", "max_speed [m/s]", "m/s", 1},
    {"density error", "density_error", "%", 100},
    {"iterations", "iterations", "", 1},
    {"time step", "dt [s]", "s", 1},
    {"particles", "particles", "", 1},
    {"pieces", "pieces", "", 1},
    {"wetted area", "wetted_area [m^2]", "m^2", 1},
    {"radius of gyration", "radius_of_gyration [m]", "m", 1},
});

std::vector<Series> followed_series() {
  std::vector<Series> series;
  for (const Followed& each : followed) series.push_back({each.title, each.unit});
  return series;
}

}  // namespace

ResultSource::ResultSource(Results results)
    : scene_(results.scene),
      folder_(results.folder),
      frames_(results.frames),
      stage_(app::stage_of(scene_)),
      history_(followed_series()),
      player_(std::move(results), stage_) {
  notes_.read_only = true;
  read_history();
  player_.show(wish_);
}

bool ResultSource::update() {
  const auto now = std::chrono::steady_clock::now();
  const double passed = std::min(0.25, std::chrono::duration<double>(now - last_).count());
  last_ = now;
  FrameNews news = player_.take();
  fault_ = std::move(news.fault);
  if (news.frames) {
    frames_ = std::move(*news.frames);
    shown_ = std::min(shown_, frames_.size() - 1);
    read_history();
  }
  if (news.moment) {
    waiting_ = news.frame != wish_.frame;
    shown_ = std::min(news.frame, frames_.size() - 1);
    particles_ = news.moment->points.size() / 3;
    fields_ = std::move(news.fields);
    moment_ = std::move(news.moment);
  }
  if (!fault_.empty()) {
    waiting_ = false;
    playing_ = false;
  }
  if (playing_ && !waiting_) {
    clock_ += passed * static_cast<double>(speed_);
    go_on();
  }
  return false;
}

/// Shows the frame that the clock has come to. It waits for frames that take long to read: none is left out for that.
void ResultSource::go_on() {
  const double end = frames_.back().time;
  if (clock_ > end && shown_ + 1 >= frames_.size()) {
    if (loop_) {
      clock_ = frames_.front().time;
    } else {
      playing_ = false;
      return;
    }
  }
  const auto after = std::upper_bound(frames_.begin(), frames_.end(), clock_,
                                      [](double time, const ResultFrame& frame) { return time < frame.time; });
  const auto place = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - frames_.begin() - 1, 0));
  if (place != wish_.frame) go_to(place);
}

void ResultSource::go_to(std::size_t frame) {
  wish_.frame = std::min(frame, frames_.size() - 1);
  waiting_ = true;
  player_.show(wish_);
}

void ResultSource::colour_by(const std::string& field) {
  wish_.field = field;
  go_to(wish_.frame);
}

void ResultSource::want_surface(const std::optional<SurfaceSettings>& settings) {
  wish_.surface = settings;
  go_to(wish_.frame);
}

void ResultSource::act(Action action) {
  switch (action) {
    case Action::play:
      playing_ = !playing_;
      if (playing_ && wish_.frame + 1 >= frames_.size()) go_to(0);
      clock_ = frames_[wish_.frame].time;
      break;
    case Action::forward:
      playing_ = false;
      go_to(wish_.frame + 1);
      break;
    case Action::backward:
      playing_ = false;
      go_to(wish_.frame == 0 ? 0 : wish_.frame - 1);
      break;
    case Action::reset:
      go_to(0);
      clock_ = frames_.front().time;
      break;
    default:
      break;
  }
}

void ResultSource::read_history() {
  const app::StatsTable table(folder_ / "stats.csv");
  const std::vector<double>& times = table.column("time [s]");
  history_.clear();
  for (std::size_t row = 0; row < times.size(); ++row) {
    std::array<double, followed.size()> values{};
    for (std::size_t k = 0; k < followed.size(); ++k) {
      const std::vector<double>& column = table.column(followed[k].column);
      values[k] = row < column.size() ? followed[k].factor * column[row] : 0;
    }
    history_.add(times[row], values);
  }
}

void ResultSource::draw_controls() {
  if (wide_button(playing_ ? "Pause" : "Play", 4, 0)) act(Action::play);
  ImGui::SameLine();
  if (wide_button("<", 4, 1)) act(Action::backward);
  ImGui::SameLine();
  if (wide_button(">", 4, 2)) act(Action::forward);
  ImGui::SameLine();
  if (wide_button("Start", 4, 3)) act(Action::reset);
  auto frame = static_cast<int>(wish_.frame);
  ImGui::SetNextItemWidth(-FLT_MIN);
  const std::string label =
      fmt::format("{:.4g} s, frame {} of {}", frames_[wish_.frame].time, wish_.frame + 1, frames_.size());
  if (ImGui::SliderInt("##frame", &frame, 0, static_cast<int>(frames_.size()) - 1, label.c_str(),
                       ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput)) {
    go_to(static_cast<std::size_t>(frame));
    clock_ = frames_[wish_.frame].time;
  }
  ImGui::Checkbox("loop", &loop_);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::SliderFloat("##speed", &speed_, 0.001F, 100, "%.3g x real time", ImGuiSliderFlags_Logarithmic);
}

void ResultSource::draw_parameters() {
  ImGui::TextDisabled("As the run had them; they cannot be changed.");
  ImGui::PushStyleVar(ImGuiStyleVar_DisabledAlpha, 0.85F);
  edit_fields(scene_, notes_);
  ImGui::PopStyleVar();
}

std::string ResultSource::status() const {
  return fmt::format("{}  |  t = {:.4g} s  |  frame {} of {}  |  {} particles", playing_ ? "playing" : "paused",
                     frames_[shown_].time, shown_ + 1, frames_.size(), particles_);
}

}  // namespace sessile::viewer
