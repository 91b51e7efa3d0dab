#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include "draw/image.h"

namespace sessile::viewer {

/// Saves pictures and videos of what is shown, under names that tell scene and time.
class Capture {
 public:
  /// `name` is that of the scene; the folder is made when something is saved.
  Capture(std::filesystem::path folder, std::string name) : folder_(std::move(folder)), name_(std::move(name)) {}

  /// Saves a picture; says where. Throws FileError.
  std::string save(const draw::Image& image, double time);

  bool recording() const { return video_ != nullptr; }

  /// Begins a video of pictures of that size; says where. Throws Error, FileError.
  std::string start(int width, int height, double time);

  /// Adds a picture: as often as the time since the last one asks for, or once when `once`.
  /// A picture of another size is passed over and false returned.
  bool add(const draw::Image& image, bool once);

  /// Whether the wall clock asks for a picture.
  bool due() const;

  /// Ends the video; says where it is. Throws Error.
  std::string finish();

 private:
  std::filesystem::path free_name(double time, const char* extension) const;

  std::filesystem::path folder_;
  std::string name_;
  std::unique_ptr<draw::Video> video_;
  std::filesystem::path video_file_;
  int width_ = 0, height_ = 0;
  std::int64_t pictures_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace sessile::viewer
