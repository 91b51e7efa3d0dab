#include "view/result_player.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "shown.h"
#include "view/surface_maker.h"

namespace sessile::viewer {
namespace {

constexpr std::size_t cache_bytes = std::size_t{512} << 20;
constexpr std::size_t frames_ahead = 8;
constexpr std::chrono::seconds look_interval{1};

std::size_t bytes(const Snapshot& snapshot) {
  std::size_t total = sizeof(float) * snapshot.points.size();
  for (const Column& column : snapshot.columns) {
    total += std::visit([](const auto& values) { return values.size() * sizeof(values[0]); }, column.values);
  }
  return total;
}

std::size_t distance(std::size_t a, std::size_t b) { return a > b ? a - b : b - a; }

}  // namespace

ResultPlayer::ResultPlayer(Results results, draw::Stage stage)
    : results_(std::move(results)),
      stage_(std::move(stage)),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

void ResultPlayer::show(FrameWish wish) {
  {
    const std::lock_guard lock(mutex_);
    wish_.emplace(std::move(wish));
  }
  wake_.notify_one();
}

FrameNews ResultPlayer::take() {
  FrameNews news;
  const std::lock_guard lock(mutex_);
  std::swap(news, news_);
  news_.fault = news.fault;
  return news;
}

void ResultPlayer::work(const std::stop_token& stop) {
  auto looked = std::chrono::steady_clock::now();
  std::size_t at = 0;
  while (!stop.stop_requested()) {
    std::optional<FrameWish> wish;
    {
      std::unique_lock lock(mutex_);
      wish = std::exchange(wish_, {});
    }
    if (wish) {
      at = wish->frame;
      fulfil(*wish);
      continue;
    }
    if (std::chrono::steady_clock::now() - looked > look_interval) {
      look_for_frames();
      looked = std::chrono::steady_clock::now();
    }
    if (read_ahead(at)) continue;
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, stop, look_interval, [&] { return wish_.has_value(); });
  }
}

void ResultPlayer::fulfil(const FrameWish& wish) {
  std::optional<draw::Moment> moment;
  std::vector<std::string> fields;
  std::string fault;
  try {
    const auto snapshot = frame(wish.frame);
    fields = app::shown_fields(*snapshot);
    const bool there = std::find(fields.begin(), fields.end(), wish.field) != fields.end();
    moment = app::moment_of(*snapshot, there ? wish.field : "", stage_);
    if (wish.surface) add_surface(*moment, results_.scene.spacing, *wish.surface);
  } catch (const std::exception& e) {
    fault = e.what();
    moment.reset();
  }
  const std::lock_guard lock(mutex_);
  news_.fault = std::move(fault);
  if (!moment) return;
  std::swap(news_.moment, moment);
  news_.frame = wish.frame;
  news_.fields = std::move(fields);
}

/// Reads one of the frames that come next, if there is one to be read.
bool ResultPlayer::read_ahead(std::size_t place) {
  const std::size_t end = std::min(place + 1 + frames_ahead, results_.frames.size());
  std::size_t held = 0;
  for (const auto& [each, snapshot] : cache_) held += bytes(*snapshot);
  for (std::size_t next = place + 1; next < end; ++next) {
    if (cache_.contains(next)) continue;
    const std::size_t of_one = cache_.empty() ? 0 : held / cache_.size();
    if ((next - place + 1) * of_one > cache_bytes) return false;
    try {
      frame(next);
    } catch (const std::exception&) {
      return false;  // who wishes for it will be told
    }
    return true;
  }
  return false;
}

void ResultPlayer::look_for_frames() {
  try {
    Results now = open_results(results_.folder);
    if (now.frames.size() == results_.frames.size()) return;
    if (now.frames.size() < results_.frames.size()) cache_.clear();  // another run writes there
    results_ = std::move(now);
  } catch (const std::exception&) {
    return;  // a run that has just begun anew; what is held can still be seen
  }
  std::vector<ResultFrame> frames = results_.frames;
  const std::lock_guard lock(mutex_);
  news_.frames = std::move(frames);
}

std::shared_ptr<const Snapshot> ResultPlayer::frame(std::size_t place) {
  place = std::min(place, results_.frames.size() - 1);
  auto& held = cache_[place];
  if (held == nullptr) {
    try {
      held = std::make_shared<const Snapshot>(read_frame(results_.frames[place].file));
    } catch (...) {
      cache_.erase(place);
      throw;
    }
  }
  auto result = held;
  forget_far_from(place);
  return result;
}

void ResultPlayer::forget_far_from(std::size_t place) {
  std::size_t held = 0;
  for (const auto& [each, snapshot] : cache_) held += bytes(*snapshot);
  while (held > cache_bytes && cache_.size() > 1) {
    const auto farthest = std::max_element(cache_.begin(), cache_.end(), [&](const auto& a, const auto& b) {
      return distance(a.first, place) < distance(b.first, place);
    });
    held -= bytes(*farthest->second);
    cache_.erase(farthest);
  }
}

}  // namespace sessile::viewer
