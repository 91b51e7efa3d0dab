#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/moment.h"
#include "sessile/scene/scene.h"
#include "sessile/scene/surface_settings.h"
#include "view/history.h"
#include "view/keys.h"

namespace sessile::viewer {

/// What is shown: a simulation under way, or the results of one. The window asks it once per picture.
class Source {
 public:
  Source() = default;
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  /// Looks for what has come; true when the stage is another one.
  virtual bool update() = 0;

  /// The newest moment, once.
  virtual std::optional<draw::Moment> take_moment() = 0;

  virtual draw::Stage stage() const = 0;
  virtual bool moves() const = 0;  ///< whether something comes without the user's doing
  virtual const History& history() const = 0;
  virtual double time() const = 0;  ///< of what is shown [s]

  virtual std::vector<std::string> fields() const = 0;
  virtual void colour_by(const std::string& field) = 0;
  virtual void want_surface(const std::optional<SurfaceSettings>& settings) = 0;

  /// Play, a step, a reset: what concerns time.
  virtual void act(Action action) = 0;
  /// Whether a video takes each moment once, in place of what is shown at equal times of the wall clock.
  virtual bool video_by_moment() const = 0;

  virtual void draw_controls() = 0;    ///< buttons and sliders of time, with ImGui
  virtual void draw_parameters() = 0;  ///< of the scene
  virtual std::string status() const = 0;
  virtual std::string fault() const = 0;  ///< what went wrong; empty while nothing has
};

}  // namespace sessile::viewer
