#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "draw/moment.h"
#include "sessile/results/results.h"
#include "sessile/scene/surface_settings.h"

namespace sessile::viewer {

/// What of a run's results one would like to see.
struct FrameWish {
  std::size_t frame = 0;                   ///< place in the list of frames
  std::string field;                       ///< that colours; "" or one that is not there: speed
  std::optional<SurfaceSettings> surface;  ///< of the surface to make, if one is wanted
};

/// What has come since one last asked.
struct FrameNews {
  std::optional<draw::Moment> moment;              ///< the newest
  std::size_t frame = 0;                           ///< with `moment`: which one it is
  std::vector<std::string> fields;                 ///< with `moment`: what could colour it
  std::optional<std::vector<ResultFrame>> frames;  ///< when the run has written more of them
  std::string fault;                               ///< why the frame wished for cannot be shown
};

/// Reads frames in a thread of its own: the one wished for, then those after it, and looks for new ones.
class ResultPlayer {
 public:
  ResultPlayer(Results results, draw::Stage stage);
  ResultPlayer(const ResultPlayer&) = delete;
  ResultPlayer& operator=(const ResultPlayer&) = delete;

  void show(FrameWish wish);
  FrameNews take();

 private:
  void work(const std::stop_token& stop);
  void fulfil(const FrameWish& wish);
  bool read_ahead(std::size_t frame);
  void look_for_frames();
  std::shared_ptr<const Snapshot> frame(std::size_t place);
  void forget_far_from(std::size_t place);

  // The thread's own.
  Results results_;
  draw::Stage stage_;
  std::map<std::size_t, std::shared_ptr<const Snapshot>> cache_;  // by place

  // Both sides'.
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<FrameWish> wish_;
  FrameNews news_;

  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace sessile::viewer
