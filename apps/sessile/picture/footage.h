#pragma once

#include <functional>
#include <string>
#include <vector>

#include "draw/moment.h"
#include "picture/options.h"
#include "sessile/results/results.h"
#include "sessile/scene/read.h"
#include "sessile/simulation.h"

namespace sessile::app {

/// Takes a moment; may keep it.
using TakeMoment = std::function<void(draw::Moment&&)>;

/// Moments out of a folder of results.
class FolderFootage {
 public:
  /// Throws Error of what is not there: the folder, frames, the field.
  explicit FolderFootage(const PictureOptions& options);

  const draw::Stage& stage() const { return stage_; }
  std::size_t count() const { return frames_.size(); }

  /// Hands out the frames that were chosen, one after the other, until a signal asks for the end.
  void play(const TakeMoment& take) const;

  /// Some of them, spread evenly: to find out where they are and what colours they take.
  std::vector<draw::Moment> sample() const;

 private:
  draw::Moment read(const ResultFrame& frame, bool with_surface) const;

  const PictureOptions& options_;
  Results results_;
  draw::Stage stage_;
  std::vector<ResultFrame> frames_;
};

/// Moments out of a scene that is run for them.
class SceneFootage {
 public:
  /// Throws SceneError, and Error of a field that is not there.
  explicit SceneFootage(const PictureOptions& options);

  const draw::Stage& stage() const { return stage_; }
  std::size_t count() const { return times_.size(); }

  /// Runs the scene with progress, and hands out each state at or after a chosen time, until a signal asks for the end.
  /// Throws RunError. To be called once.
  void play(const TakeMoment& take);

 private:
  const PictureOptions& options_;
  ResolvedScene scene_;
  draw::Stage stage_;
  std::vector<double> times_;
  Simulation simulation_;
};

}  // namespace sessile::app
