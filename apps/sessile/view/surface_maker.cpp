#include "view/surface_maker.h"

#include <exception>
#include <utility>

#include "sessile/surface/reconstruct.h"

namespace sessile::viewer {

void add_surface(draw::Moment& moment, double spacing, const SurfaceSettings& settings) {
  Snapshot points{moment.time, 0, moment.points, {}};
  if (!moment.values.empty()) points.columns.push_back({moment.field, moment.unit, 1, moment.values});
  moment.surface = reconstruct(points, spacing, settings);
}

SurfaceMaker::SurfaceMaker() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

void SurfaceMaker::make(draw::Moment moment, double spacing, const SurfaceSettings& settings) {
  std::optional<Work> wanted(Work{std::move(moment), spacing, settings});
  {
    const std::lock_guard lock(mutex_);
    std::swap(next_, wanted);
  }
  wake_.notify_one();
}

std::optional<draw::Moment> SurfaceMaker::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(made_, {});
}

bool SurfaceMaker::busy() {
  const std::lock_guard lock(mutex_);
  return busy_ || next_ || made_;
}

std::string SurfaceMaker::fault() {
  const std::lock_guard lock(mutex_);
  return fault_;
}

void SurfaceMaker::work(const std::stop_token& stop) {
  for (;;) {
    std::optional<Work> now;
    {
      std::unique_lock lock(mutex_);
      busy_ = false;
      if (!wake_.wait(lock, stop, [&] { return next_.has_value(); })) return;
      now = std::exchange(next_, {});
      busy_ = true;
    }
    std::string fault;
    try {
      add_surface(now->moment, now->spacing, now->settings);
    } catch (const std::exception& e) {
      fault = e.what();
    }
    std::optional<draw::Moment> made(std::move(now->moment));
    const std::lock_guard lock(mutex_);
    fault_ = std::move(fault);
    std::swap(made_, made);
  }
}

}  // namespace sessile::viewer
