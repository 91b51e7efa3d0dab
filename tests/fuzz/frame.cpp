#include <variant>

#include "fuzz/targets.h"
#include "sessile/output/frames.h"
#include "sessile/results/frame_files.h"

namespace sessile::fuzz {
namespace {

/// What every reader of frames relies on, and that what was read can be written.
void use(const Snapshot& frame) {
  must(frame.points.size() % 3 == 0, "a place of fewer than three numbers");
  for (const Column& column : frame.columns) {
    must(column.components == 1 || column.components == 3, "a column of neither numbers nor vectors");
    const std::size_t numbers = std::visit([](const auto& values) { return values.size(); }, column.values);
    must(numbers == frame.size() * static_cast<std::size_t>(column.components), "a column of another length");
  }
  static_cast<void>(encode_vtp(frame));
}

}  // namespace

void read_frame_ply(std::string_view bytes) {
  static_cast<void>(ply_moment(bytes.substr(0, 4096)));
  use(parse_ply_frame(bytes));
}

void read_frame_vtp(std::string_view bytes) {
  static_cast<void>(vtp_moment(bytes.substr(0, 4096)));
  use(parse_vtp_frame(std::string(bytes)));
}

}  // namespace sessile::fuzz
