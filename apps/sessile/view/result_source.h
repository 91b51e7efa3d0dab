#pragma once

#include <chrono>

#include "sessile/results/results.h"
#include "view/field_editor.h"
#include "view/result_player.h"
#include "view/source.h"

namespace sessile::viewer {

/// The frames of a run, done or still going on.
class ResultSource final : public Source {
 public:
  explicit ResultSource(Results results);

  bool update() override;
  std::optional<draw::Moment> take_moment() override { return std::exchange(moment_, {}); }
  draw::Stage stage() const override { return stage_; }
  bool moves() const override { return playing_ || shown_ != wish_.frame || waiting_; }
  const History& history() const override { return history_; }
  double time() const override { return frames_[shown_].time; }
  std::vector<std::string> fields() const override { return fields_; }
  void colour_by(const std::string& field) override;
  void want_surface(const std::optional<SurfaceSettings>& settings) override;
  void act(Action action) override;
  bool video_by_moment() const override { return true; }
  void draw_controls() override;
  void draw_parameters() override;
  std::string status() const override;
  std::string fault() const override { return fault_; }

 private:
  void go_to(std::size_t frame);
  void go_on();
  void read_history();

  Scene scene_;
  std::filesystem::path folder_;
  std::vector<ResultFrame> frames_;
  draw::Stage stage_;
  FieldNotes notes_;
  std::optional<draw::Moment> moment_;
  std::vector<std::string> fields_;
  std::string fault_;
  History history_;
  FrameWish wish_;
  std::size_t shown_ = 0, particles_ = 0;
  bool waiting_ = true;  // for the frame wished for
  bool playing_ = false, loop_ = false;
  float speed_ = 1;   // simulated seconds per wall second
  double clock_ = 0;  // simulated time while it plays [s]
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  ResultPlayer player_;
};

}  // namespace sessile::viewer
