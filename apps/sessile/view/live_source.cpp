#include "view/live_source.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "sessile/output/check.h"
#include "sessile/scene/tuning.h"
#include "sessile/scene/validate.h"
#include "shown.h"
#include "view/widgets.h"

namespace sessile::viewer {
namespace {

const std::vector<Series> followed{{"kinetic energy", "J"},   {"greatest speed", "m/s"}, {"density error", "%"},
                                   {"iterations", ""},        {"time step", "s"},        {"particles", ""},
                                   {"wall time a step", "ms"}};

std::string state_text(LiveState state) {
  switch (state) {
    case LiveState::playing:
      return "running";
    case LiveState::ended:
      return "reached time.end";
    case LiveState::failed:
      return "failed";
    case LiveState::paused:
      break;
  }
  return "paused";
}

}  // namespace

LiveSource::LiveSource(Simulation simulation, int threads)
    : running_(simulation.scene()),
      wanted_(running_),
      stage_(app::stage_of(running_)),
      run_(std::move(simulation), threads),
      history_(followed) {
  notes_.marks_resets = true;
}

bool LiveSource::update() {
  LiveNews news = run_.take();
  state_ = news.state;
  fault_ = news.fault;
  if (news.scene) {
    running_ = std::move(*news.scene);
    fields_ = std::move(news.fields);
    judge();
  }
  const bool anew = news.stage.has_value();
  if (anew) {
    stage_ = std::move(*news.stage);
    history_.clear();
    now_ = {};
  }
  follow(news.samples);
  if (news.moment) {
    waiting_ = false;
    if (surface_) surfaces_.make(*news.moment, running_.spacing, *surface_);
    moment_ = std::move(news.moment);
    fresh_ = true;
  }
  return anew;
}

void LiveSource::follow(const std::vector<LiveSample>& samples) {
  for (const LiveSample& s : samples) {
    const double walls = s.wall - now_.wall;
    if (s.steps > now_.steps && walls > 0) {
      const double pace = (s.time - now_.time) / walls;
      const double weight = std::min(1.0, walls / 0.5);
      pace_ += weight * (pace - pace_);
      step_milliseconds_ += (step_milliseconds_ > 0 ? 0.2 : 1.0) * (s.milliseconds - step_milliseconds_);
    }
    now_ = s;
    if (!history_.times().empty() && s.time == history_.times().back()) continue;
    history_.add(s.time, std::array{s.last.kinetic_energy, s.max_speed, 100 * s.density_error,
                                    static_cast<double>(s.last.iterations), s.last.dt, static_cast<double>(s.particles),
                                    s.milliseconds});
  }
}

std::optional<draw::Moment> LiveSource::take_moment() {
  if (surface_) return surfaces_.take();
  if (!fresh_) return {};
  fresh_ = false;
  return moment_;
}

bool LiveSource::moves() const {
  return state_ == LiveState::playing || waiting_ || fresh_ || (surface_ && surfaces_.busy());
}

void LiveSource::want_surface(const std::optional<SurfaceSettings>& settings) {
  surface_ = settings;
  if (surface_ && moment_) surfaces_.make(*moment_, running_.spacing, *surface_);
  fresh_ = moment_.has_value();
}

void LiveSource::act(Action action) {
  switch (action) {
    case Action::play:
      if (state_ == LiveState::playing) {
        run_.pause();
      } else {
        run_.play();
      }
      waiting_ = true;
      break;
    case Action::forward:
      run_.pause();
      run_.step();
      waiting_ = true;
      break;
    case Action::reset:
      run_.reset(wanted_);
      waiting_ = true;
      break;
    default:
      break;
  }
}

/// Hands over what may change at once, if it is sound by itself; the rest waits for a reset.
void LiveSource::edited() {
  Scene next = tuned(running_, wanted_);
  if (validate(next).empty() && check_output(next).empty() && !differing_parameters(running_, next).empty()) {
    run_.change(std::move(next));
    waiting_ = true;
  }
  judge();
}

void LiveSource::judge() {
  notes_.faults.clear();
  for (const auto& faults : {validate(wanted_), check_output(wanted_)}) {
    for (const Fault& fault : faults) notes_.faults.emplace(fault.path, fault.message);
  }
  notes_.pending.clear();
  for (std::string& path : differing_parameters(wanted_, running_)) {
    if (!may_change_between_steps(path)) notes_.pending.insert(std::move(path));
  }
}

void LiveSource::draw_controls() {
  const bool playing = state_ == LiveState::playing;
  if (wide_button(playing ? "Pause" : "Play", 3, 0)) act(Action::play);
  ImGui::SameLine();
  if (wide_button("Step", 3, 1)) act(Action::forward);
  ImGui::SameLine();
  if (wide_button("Reset", 3, 2)) act(Action::reset);
  bool changed = ImGui::Checkbox("at most", &limited_);
  tooltip("Off: as fast as the steps go.");
  ImGui::SameLine();
  ImGui::BeginDisabled(!limited_);
  ImGui::SetNextItemWidth(-FLT_MIN);
  changed |= ImGui::SliderFloat("##speed", &speed_, 0.001F, 100, "%.3g x real time", ImGuiSliderFlags_Logarithmic);
  ImGui::EndDisabled();
  if (changed) run_.limit(limited_ ? std::optional<double>(speed_) : std::nullopt);
}

void LiveSource::draw_parameters() {
  if (!notes_.pending.empty()) {
    ImGui::TextColored(amber, "%s", fmt::format("{} wait for a reset", notes_.pending.size()).c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton("reset now")) act(Action::reset);
    ImGui::SameLine();
    if (ImGui::SmallButton("undo")) {
      wanted_ = running_;
      judge();
    }
  } else {
    ImGui::TextDisabled("* takes effect at reset, all else at once");
  }
  const auto whole = notes_.faults.find("");
  if (whole != notes_.faults.end()) ImGui::TextColored(red, "%s", whole->second.c_str());
  if (edit_fields(wanted_, notes_)) edited();
}

std::string LiveSource::status() const {
  std::string text = fmt::format("{}  |  t = {:.4g} s", state_text(state_), now_.time);
  if (now_.steps > 0) {
    const StepReport& last = now_.last;
    text += fmt::format("  |  step {}: {:.3g} ms by {}{}", now_.steps, 1e3 * last.dt, last.bound,
                        last.overruled.empty() ? "" : fmt::format(", above the {} bound", last.overruled));
    text += fmt::format("  |  {} iterations{}", last.iterations, last.converged ? "" : " (not converged)");
  }
  text += fmt::format("  |  {} particles", now_.particles);
  if (now_.out > 0) text += fmt::format(", {} out", now_.out);
  if (now_.lost > 0) text += fmt::format(", {} lost", now_.lost);
  if (step_milliseconds_ > 0) text += fmt::format("  |  {:.3g} ms a step", step_milliseconds_);
  if (state_ == LiveState::playing) text += fmt::format("  |  {:.2g} x real time", pace_);
  return text;
}

}  // namespace sessile::viewer
