#include "sessile/checkpoint/checkpoint.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <vector>

#include "sessile/checkpoint/archive.h"
#include "sessile/core/error.h"
#include "sessile/core/hash.h"
#include "sessile/core/memory_limit.h"
#include "sessile/output/durable.h"
#include "sessile/scene/input_file.h"

namespace sessile {
namespace {

constexpr std::string_view magic = "SESSILE\n";

/// What stands in front of the content.
struct Header {
  std::uint32_t format = checkpoint_format;
  std::uint32_t real_bytes = sizeof(Real);
  std::uint64_t raw_bytes = 0;
  std::uint64_t checksum = 0;
};
static_assert(sizeof(Header) == 24 && std::is_trivially_copyable_v<Header>);
constexpr std::size_t header_bytes = magic.size() + sizeof(Header);

std::uint64_t checksum(Header header, std::string_view content) {
  header.checksum = 0;
  return hash(content.data(), content.size(), hash(&header, sizeof header));
}

template <class A, class C>
void fields(A& archive, C& checkpoint) {
  archive(checkpoint.version, checkpoint.isa, checkpoint.scene_json, checkpoint.session, checkpoint.state);
}

/// Bytes that a file and its content may each have. The packed bytes, the content as it grows, which may take twice its
/// length for a moment, and the state that is read from it stand side by side.
std::uint64_t most_bytes() {
  constexpr double side_by_side = 4;
  return static_cast<std::uint64_t>(memory_limit().bytes / side_by_side);
}

/// Grows with what is unpacked: a header that lies takes no memory.
std::string decompressed(std::string_view content, std::uint64_t raw_bytes) {
  const auto told = ZSTD_getFrameContentSize(content.data(), content.size());
  if (told != ZSTD_CONTENTSIZE_UNKNOWN && told != ZSTD_CONTENTSIZE_ERROR && told != raw_bytes) {
    throw Error("holds another length than it tells of");
  }
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  std::string raw;
  std::vector<char> block(ZSTD_DStreamOutSize());
  ZSTD_inBuffer in{content.data(), content.size(), 0};
  for (std::size_t left = 1; left != 0;) {
    const std::size_t before = in.pos;
    ZSTD_outBuffer out{block.data(), block.size(), 0};
    left = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(left) != 0) throw Error(std::string("zstd: ") + ZSTD_getErrorName(left));
    if (out.pos > raw_bytes - raw.size()) throw Error("holds more than it tells of");
    raw.append(block.data(), out.pos);
    if (left != 0 && out.pos == 0 && in.pos == before) throw Error("ends too early");
  }
  if (raw.size() != raw_bytes) throw Error("holds less than it tells of");
  if (in.pos != in.size) throw Error("holds more than it should");
  return raw;
}

}  // namespace

std::string encode_checkpoint(const Checkpoint& checkpoint) {
  StateWriter writer;
  fields(writer, checkpoint);
  const std::string content = writer.finish();
  Header header;
  header.raw_bytes = writer.raw_bytes();
  header.checksum = checksum(header, content);
  std::string bytes;
  bytes.reserve(header_bytes + content.size());
  bytes.append(magic).append(reinterpret_cast<const char*>(&header), sizeof header).append(content);
  return bytes;
}

Checkpoint decode_checkpoint(std::string_view bytes, const std::string& name, std::uint64_t most) {
  const auto refuse = [&](std::string_view what) { throw FileError(fmt::format("{}: {}", name, what)); };
  if (!bytes.starts_with(magic)) refuse("is no checkpoint of Sessile");
  if (bytes.size() < header_bytes) refuse("this checkpoint is cut short");
  Header header;
  std::memcpy(&header, bytes.data() + magic.size(), sizeof header);
  const std::string_view content = bytes.substr(header_bytes);
  // A newer format may count its checksum in another way, so that its number comes first.
  if (header.format > checkpoint_format) {
    throw ForeignCheckpoint(
        fmt::format("{}: this checkpoint is of format {}, and this program reads up to format {}: a newer Sessile "
                    "goes on from it",
                    name, header.format, checkpoint_format));
  }
  if (header.format == 0 || header.checksum != checksum(header, content)) {
    refuse("this checkpoint is damaged or cut short: its checksum does not match");
  }
  if (header.real_bytes != sizeof(Real)) {
    throw ForeignCheckpoint(
        fmt::format("{}: this checkpoint is of a build with {}-bit numbers, and this one has {}-bit numbers", name,
                    8 * header.real_bytes, 8 * sizeof(Real)));
  }
  if (header.raw_bytes > (most > 0 ? most : most_bytes())) {
    refuse(fmt::format("this checkpoint tells of {:.3g} GiB, which is more than there is memory for",
                       static_cast<double>(header.raw_bytes) / (1 << 30)));
  }
  Checkpoint checkpoint;
  checkpoint.format = header.format;
  try {
    const std::string raw = decompressed(content, header.raw_bytes);
    StateReader reader(raw);
    fields(reader, checkpoint);
    if (!reader.at_end()) throw Error("holds more than it should");
  } catch (const Error& e) {
    refuse(fmt::format("this checkpoint {}", e.what()));
  }
  return checkpoint;
}

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  write_durably(file, encode_checkpoint(checkpoint));
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  std::string bytes;
  try {
    bytes = read_input(file, most_bytes());
  } catch (const FileError& fault) {
    throw FileError(fmt::format("cannot read {}: {}", file.string(), fault.what()));
  }
  return decode_checkpoint(bytes, file.string());
}

bool is_checkpoint(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  std::ifstream stream(file, std::ios::binary);
  std::array<char, magic.size()> start{};
  return stream.read(start.data(), start.size()) && std::string_view(start.data(), start.size()) == magic;
}

}  // namespace sessile
