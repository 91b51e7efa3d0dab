#include "view/capture.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "sessile/output/file.h"

namespace sessile::viewer {
namespace {

constexpr double frames_per_second = 30;
constexpr std::int64_t most_at_once = 30;  // copies of a picture, after a long pause

std::int64_t pictures_due(std::chrono::steady_clock::time_point start) {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return static_cast<std::int64_t>(seconds * frames_per_second) + 1;
}

}  // namespace

std::filesystem::path Capture::free_name(double time, const char* extension) const {
  create_output_folder(folder_);
  const std::string stem = fmt::format("view_{}_{:.4f}s", name_, time);
  std::filesystem::path file = folder_ / (stem + extension);
  std::error_code error;
  for (int k = 2; std::filesystem::exists(file, error); ++k)
    file = folder_ / fmt::format("{}_{}{}", stem, k, extension);
  return file;
}

std::string Capture::save(const draw::Image& image, double time) {
  const auto file = free_name(time, ".png");
  draw::write_png(file, image);
  return fmt::format("saved {}", file.string());
}

std::string Capture::start(int width, int height, double time) {
  video_file_ = free_name(time, ".mp4");
  video_ = std::make_unique<draw::Video>(video_file_, width, height, frames_per_second);
  width_ = width;
  height_ = height;
  pictures_ = 0;
  start_ = std::chrono::steady_clock::now();
  return fmt::format("recording {}; V ends it", video_file_.string());
}

bool Capture::due() const { return recording() && pictures_due(start_) > pictures_; }

bool Capture::add(const draw::Image& image, bool once) {
  if (image.width != width_ || image.height != height_) return false;
  const std::int64_t copies = once ? 1 : pictures_due(start_) - pictures_;
  for (std::int64_t k = 0; k < std::min(copies, most_at_once); ++k) video_->add(image);
  pictures_ += copies;
  return true;
}

std::string Capture::finish() {
  const auto video = std::move(video_);
  video->finish();
  return fmt::format("saved {}, {:.1f} s", video_file_.string(), static_cast<double>(pictures_) / frames_per_second);
}

}  // namespace sessile::viewer
