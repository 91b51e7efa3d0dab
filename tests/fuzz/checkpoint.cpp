#include "sessile/checkpoint/checkpoint.h"

#include <zstd.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cstring>

#include "fuzz/small_simulation.h"
#include "fuzz/targets.h"
#include "sessile/scene/read.h"

namespace sessile::fuzz {
namespace {

constexpr std::uint64_t most = std::uint64_t{64} << 20;

void use(const Checkpoint& checkpoint) {
  must(encode_checkpoint(checkpoint) == encode_checkpoint(decode_checkpoint(encode_checkpoint(checkpoint), "again")),
       "a checkpoint does not come back from its own file");
  go_on_when_small(read_resolved_text(checkpoint.scene_json, "checkpoint").scene, checkpoint.state);
}

}  // namespace

void read_checkpoint(std::string_view bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 1));
  // Magic, format, bytes of a Real, length, checksum: as encode_checkpoint() tells.
  std::array<char, 24> head{};
  const std::uint32_t format = checkpoint_format, real_bytes = sizeof(Real);
  const std::uint64_t length = bytes.size();
  std::memcpy(head.data(), &format, 4);
  std::memcpy(head.data() + 4, &real_bytes, 4);
  std::memcpy(head.data() + 8, &length, 8);
  const std::uint64_t sum = XXH3_64bits_withSeed(packed.data(), packed.size(), XXH3_64bits(head.data(), head.size()));
  std::memcpy(head.data() + 16, &sum, 8);
  use(decode_checkpoint("SESSILE\n" + std::string(head.data(), head.size()) + packed, "checkpoint", most));
}

void read_checkpoint_file(std::string_view bytes) { use(decode_checkpoint(bytes, "checkpoint", most)); }

}  // namespace sessile::fuzz
