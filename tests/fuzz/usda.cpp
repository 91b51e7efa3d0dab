#include "sessile/output/usda.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "fuzz/scratch_folder.h"
#include "fuzz/targets.h"
#include "sessile/core/error.h"

namespace sessile::fuzz {
namespace {

constexpr double rate = 10, until = 0.5, next = 0.6;  // frames a second, the last frame that stays, one more [s]

SurfaceMesh triangle() {
  SurfaceMesh mesh;
  mesh.time = next;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  mesh.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  mesh.triangles = {0, 1, 2};
  return mesh;
}

/// Goes on with what stands in the folder, adds a frame, and goes on with what that makes.
void go_on(const ScratchFolder& folder) {
  const auto file = folder.path() / "surface.usda";
  {
    UsdaWriter writer(file, rate, 1, until);
    writer.add(triangle());
    writer.finish({0, 0, 1}, {});
  }
  must(std::filesystem::is_regular_file(file), "no file was made");
  try {
    UsdaWriter again(file, rate, 2, next);
    again.finish({0, 0, 1}, {});
  } catch (const Error&) {
    must(false, "what was gone on with cannot be gone on with again");
  }
}

}  // namespace

void read_usda(std::string_view bytes) {
  const ScratchFolder folder;
  folder.put("surface.usda", bytes);
  go_on(folder);
}

void read_usda_parts(std::string_view bytes) {
  const ScratchFolder folder;
  constexpr std::string_view cut = "----\n";
  for (int k = 0; k < 8 && !bytes.empty(); ++k) {
    const auto end = bytes.find(cut);
    folder.put(fmt::format(".surface.usda.{}.part", k), bytes.substr(0, end));
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + cut.size());
  }
  go_on(folder);
}

}  // namespace sessile::fuzz
