#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "draw/moment.h"
#include "sessile/scene/surface_settings.h"

namespace sessile::viewer {

/// Puts a surface around a moment's particles; it carries the field that colours.
void add_surface(draw::Moment& moment, double spacing, const SurfaceSettings& settings);

/// Puts surfaces around moments in a thread of its own. Of moments that come faster than surfaces are made, the newest
/// gets one.
class SurfaceMaker {
 public:
  SurfaceMaker();
  SurfaceMaker(const SurfaceMaker&) = delete;
  SurfaceMaker& operator=(const SurfaceMaker&) = delete;

  void make(draw::Moment moment, double spacing, const SurfaceSettings& settings);

  /// The newest moment that has got its surface, once.
  std::optional<draw::Moment> take();

  bool busy();
  std::string fault();  ///< of the last one; empty when it went well

 private:
  struct Work {
    draw::Moment moment;
    double spacing = 0;
    SurfaceSettings settings;
  };

  void work(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<Work> next_;
  std::optional<draw::Moment> made_;
  std::string fault_;
  bool busy_ = false;

  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace sessile::viewer
