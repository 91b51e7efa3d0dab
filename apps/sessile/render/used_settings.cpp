#include "used_settings.h"

#include <fmt/format.h>

#include <sstream>
#include <string>
#include <string_view>

#include "sessile/core/error.h"
#include "sessile/output/file.h"
#include "sessile/scene/describe.h"
#include "sessile/scene/input_file.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

bool has_pictures(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("frame_") && name.ends_with(".png")) return true;
  }
  return false;
}

std::string trimmed(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(' ');
  const std::size_t end = line.find_last_not_of(" ,");
  return begin == std::string::npos ? "" : line.substr(begin, end - begin + 1);
}

/// The text of a file of settings; an empty one where there is none, or something else in its place.
std::string settings_in(const fs::path& file) {
  constexpr std::uintmax_t largest = std::uintmax_t{16} << 20;
  try {
    return read_input(file, largest);
  } catch (const FileError&) {
    return "";
  }
}

/// The first line in which two texts differ: `"samples": 16, now "samples": 64`.
std::string first_difference(const std::string& before, const std::string& now) {
  std::istringstream old_lines(before), new_lines(now);
  std::string old_line, new_line;
  while (std::getline(old_lines, old_line) && std::getline(new_lines, new_line) && old_line == new_line) {
  }
  return fmt::format("{}, now {}", trimmed(old_line), trimmed(new_line));
}

}  // namespace

void keep_settings(const fs::path& folder, const RenderSettings& settings, bool again) {
  const fs::path file = folder / "settings.json";
  const std::string now = to_json(settings);
  const std::string before = settings_in(file);
  if (before == now) return;
  if (!again && !before.empty() && has_pictures(folder)) {
    throw SceneError(
        fmt::format("{} holds frames made with other settings ({}); --again renders anew, -o takes another folder",
                    folder.string(), first_difference(before, now)));
  }
  write_whole(file, now);
}

}  // namespace sessile::app
