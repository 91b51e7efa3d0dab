#include <fmt/format.h>

#include "sessile/output/frames.h"
#include "sessile/output/ply_rows.h"

namespace sessile {

std::string encode_ply(const Snapshot& snapshot) {
  PlyRows rows(snapshot.size());
  rows.vectors(snapshot.points, "x", "y", "z");
  for (const Column& column : snapshot.columns) rows.column(column, true);
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment Sessile, time {} s, step {}\nelement vertex {}\n{}end_header\n",
      snapshot.time, snapshot.step, snapshot.size(), rows.header());
  rows.append_to(bytes);
  return bytes;
}

}  // namespace sessile
