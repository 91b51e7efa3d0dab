#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "view/canvas.h"
#include "view/capture.h"
#include "view/panel.h"
#include "view/settings.h"
#include "view/source.h"
#include "view/window.h"

namespace sessile::viewer {

struct ViewerOptions {
  std::string name;              ///< of the scene, for titles and files
  std::filesystem::path folder;  ///< for pictures and videos
  std::int64_t frames = 0;       ///< ends after so many drawn ones; 0 for never
};

/// The window's life: asks the source, lets the user do things, paints what has changed.
class Viewer {
 public:
  Viewer(Window& window, Source& source, Settings settings, ViewerOptions options);

  /// Until the window is closed.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  bool worth_drawing();
  void draw_frame();
  void draw_interface();
  void draw_status();
  void draw_notice();
  void paint(bool whole = false);
  void film(bool fresh);
  void act(Action action);
  void act_on_view(Action action);
  void set_look(draw::Look look);
  void toggle_clip();
  void toggle_video();
  void fit(bool liquid);
  void say(std::string text);
  Region picture() const;
  double rest() const;

  Window& window_;
  Source& source_;
  Settings settings_;
  ViewerOptions options_;
  Capture capture_;
  draw::Stage stage_;
  Canvas canvas_;
  bool dirty_ = true, fitted_ = false, fresh_ = false;
  float panel_width_ = 0, status_height_ = 0;
  int restless_ = 3;  // pictures to draw although nothing seems to change: ImGui answers one late
  std::string notice_;
  Clock::time_point notice_end_{}, last_ = Clock::now(), shown_ = last_;
  Clock::time_point stirred_ = last_;  // when the picture last had a reason to change
  bool slow_ = false;                  // whether a whole picture takes too long while things move
  bool owed_ = false;                  // whether a whole picture is to follow a coarse one
  bool painted_ = false;
  double cost_ = 0;  // of the last picture [s]
  double frames_per_second_ = 0;
  std::int64_t drawn_ = 0;
};

}  // namespace sessile::viewer
