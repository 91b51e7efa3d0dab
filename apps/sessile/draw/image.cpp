#include "draw/image.h"

#include <epoxy/gl.h>
#include <zlib.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>

#include "sessile/core/error.h"
#include "sessile/output/file.h"

namespace {

/// What stb packs a picture with: zlib packs tighter than its own. stb frees what it gets by free().
unsigned char* pack(unsigned char* bytes, int size, int* packed_size, int level) {
  uLongf room = compressBound(static_cast<uLong>(size));
  auto* packed = static_cast<unsigned char*>(std::malloc(room));  // NOLINT
  if (packed == nullptr || compress2(packed, &room, bytes, static_cast<uLong>(size), level) != Z_OK) {
    std::free(packed);  // NOLINT
    return nullptr;
  }
  *packed_size = static_cast<int>(room);
  return packed;
}

}  // namespace

#define STB_IMAGE_WRITE_IMPLEMENTATION  // NOLINT
#define STB_IMAGE_WRITE_STATIC          // NOLINT
#define STBIW_ZLIB_COMPRESS pack        // NOLINT
#include <stb_image_write.h>

namespace sessile::draw {

Image read_pixels(int width, int height, unsigned framebuffer) {
  Image image{width, height, {}};
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  std::vector<std::uint8_t> upside_down(row * static_cast<std::size_t>(height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
  if (glGetError() != GL_NO_ERROR) throw Error("OpenGL cannot hand the picture's pixels back");
  image.rgb.reserve(upside_down.size());
  for (std::size_t y = static_cast<std::size_t>(height); y-- > 0;) {
    const auto start = upside_down.begin() + static_cast<std::ptrdiff_t>(y * row);
    image.rgb.insert(image.rgb.end(), start, start + static_cast<std::ptrdiff_t>(row));
  }
  return image;
}

void write_png(const std::filesystem::path& file, const Image& image) {
  std::string bytes;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, image.rgb.data(), 3 * image.width) == 0) {
    throw FileError(file.string() + ": the picture cannot be encoded: not enough memory");
  }
  write_whole(file, bytes);
}

}  // namespace sessile::draw
