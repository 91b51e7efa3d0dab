#pragma once

#include <set>

#include "sessile/simulation.h"
#include "view/field_editor.h"
#include "view/live_run.h"
#include "view/source.h"
#include "view/surface_maker.h"

namespace sessile::viewer {

/// A simulation under way, and the scene that its parameters are changed in.
class LiveSource final : public Source {
 public:
  /// `threads`: for the steps; 0 for all.
  LiveSource(Simulation simulation, int threads);

  bool update() override;
  std::optional<draw::Moment> take_moment() override;
  draw::Stage stage() const override { return stage_; }
  bool moves() const override;
  const History& history() const override { return history_; }
  double time() const override { return now_.time; }
  std::vector<std::string> fields() const override { return fields_; }
  void colour_by(const std::string& field) override { run_.colour_by(field); }
  void want_surface(const std::optional<SurfaceSettings>& settings) override;
  void act(Action action) override;
  bool video_by_moment() const override { return false; }
  void draw_controls() override;
  void draw_parameters() override;
  std::string status() const override;
  std::string fault() const override { return fault_; }

 private:
  void follow(const std::vector<LiveSample>& samples);
  void edited();
  void judge();

  Scene running_;  // as it runs
  Scene wanted_;   // as the panel has it
  FieldNotes notes_;
  draw::Stage stage_;
  LiveRun run_;
  LiveState state_ = LiveState::paused;
  LiveSample now_;
  std::optional<draw::Moment> moment_;  // the newest without a surface
  bool fresh_ = false;                  // whether it was not taken yet
  std::vector<std::string> fields_;
  std::string fault_;
  History history_;
  double step_milliseconds_ = 0, pace_ = 0;  // smoothed; simulated seconds per wall second
  float speed_ = 1;
  bool limited_ = true;
  bool waiting_ = true;  // for the answer to an order

  std::optional<SurfaceSettings> surface_;
  mutable SurfaceMaker surfaces_;
};

}  // namespace sessile::viewer
