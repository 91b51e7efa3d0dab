#include "sessile/checkpoint/archive.h"

#include <array>
#include <utility>

namespace sessile {
namespace {

// Positions and velocities of a liquid in motion hardly shrink at any level; this one keeps pace with a disk.
constexpr int level = 1;

void check(std::size_t code) {
  if (ZSTD_isError(code) != 0) throw Error(std::string("zstd: ") + ZSTD_getErrorName(code));
}

}  // namespace

StateWriter::StateWriter() : context_(ZSTD_createCCtx(), &ZSTD_freeCCtx) {
  if (!context_) throw std::bad_alloc();
  check(ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, level));
}

void StateWriter::add(const void* data, std::size_t size) {
  raw_bytes_ += size;
  if (size > 0) compress({data, size, 0}, ZSTD_e_continue);
}

std::string StateWriter::finish() {
  compress({nullptr, 0, 0}, ZSTD_e_end);
  return std::move(compressed_);
}

void StateWriter::compress(ZSTD_inBuffer in, ZSTD_EndDirective end) {
  std::array<char, 1 << 16> block;
  while (true) {
    ZSTD_outBuffer out{block.data(), block.size(), 0};
    const std::size_t left = ZSTD_compressStream2(context_.get(), &out, &in, end);
    check(left);
    compressed_.append(block.data(), out.pos);
    if (end == ZSTD_e_end ? left == 0 : in.pos == in.size) return;
  }
}

}  // namespace sessile
