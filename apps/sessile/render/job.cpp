#include "job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sessile/output/json_object.h"
#include "sessile/scene/describe.h"

namespace sessile::app {

namespace fs = std::filesystem;

std::string job_json(const RenderJob& job) {
  std::string settings = to_json(job.settings);
  settings.pop_back();
  JsonObject text(0);
  text.add("folder", fs::absolute(job.surfaces).string()).add("output", fs::absolute(job.output).string());
  if (!job.blend.empty()) text.add("blend", fs::absolute(job.blend).string());
  text.raw("frames", fmt::format("[{}]", fmt::join(job.frames, ", "))).raw("settings", indented(settings));
  return text.text() + "\n";
}

fs::path picture_of(const fs::path& folder, std::int64_t number) {
  return folder / fmt::format("frame_{:06}.png", number);
}

bool is_rendered(const fs::path& folder, const SurfaceFile& surface) {
  std::error_code error;
  const auto painted = fs::last_write_time(picture_of(folder, surface.number), error);
  if (error) return false;
  const auto made = fs::last_write_time(surface.file, error);
  return error || made <= painted;
}

}  // namespace sessile::app
