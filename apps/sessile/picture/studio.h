#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "draw/image.h"
#include "draw/moment.h"
#include "picture/options.h"

namespace sessile::app {

/// Ends of the colours that several moments have together.
std::pair<float, float> common_range(std::span<const draw::Moment> moments);

/// Draws pictures of a stage without a display.
class Studio {
 public:
  /// Throws Error when this machine cannot draw.
  explicit Studio(const PictureOptions& options);
  ~Studio();
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  /// Builds the stage, and aims the camera at it and at the particles of the moments, strays left out. `panels`
  /// pictures stand side by side.
  void set_up(const draw::Stage& stage, std::span<const draw::Moment> moments, std::size_t panels);

  /// The moments side by side, as many as there are panels, coloured between those ends.
  draw::Image draw(std::span<const draw::Moment> moments, std::pair<float, float> range);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sessile::app
