#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sessile::draw {

/// A picture in memory: rows from the top, three bytes a pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Reads the pixels of a framebuffer of the current context.
Image read_pixels(int width, int height, unsigned framebuffer);

/// Writes a PNG whole or not at all. Throws FileError.
void write_png(const std::filesystem::path& file, const Image& image);

/// A video that grows picture by picture, encoded by the program ffmpeg (H.264 in MP4, plays anywhere).
class Video {
 public:
  /// Throws Error when ffmpeg is not installed, with the package's name; FileError when the file cannot be made.
  /// Odd sizes are padded by a pixel, as H.264 wants even ones.
  Video(const std::filesystem::path& file, int width, int height, double frames_per_second);
  ~Video();  ///< ends a video that was not finished and takes the file away
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  void add(const Image& image);  ///< throws Error with ffmpeg's last words when it has failed
  void finish();                 ///< waits until the file is whole; throws as add() does

 private:
  std::filesystem::path file_, part_;
  int width_ = 0, height_ = 0;
  int pipe_ = -1;
  int process_ = -1;
  std::string words_;  // path of what ffmpeg said
};

}  // namespace sessile::draw
