#include "result_folder.h"

#include <charconv>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "checkpoints.h"
#include "fault_dump.h"
#include "mesh/surface_folder.h"
#include "sessile/core/error.h"
#include "sessile/output/file.h"
#include "sessile/output/frames.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

/// A file's name, and whether it is a half one, that a killed run left behind.
struct Name {
  explicit Name(std::string file) : name(std::move(file)) {
    constexpr std::string_view part = ".part";
    half = name.starts_with('.') && name.ends_with(part);
    if (half) name = name.substr(1, name.size() - 1 - part.size());
  }

  /// Whether it is a frame's or a solid's in one of our formats.
  bool in_known_format() const {
    const auto dot = name.rfind('.');
    return dot != std::string::npos && find_frame_format(name.substr(dot + 1)) != nullptr;
  }

  /// The number of `frame_000012.vtp`.
  std::optional<std::int64_t> frame() const {
    constexpr std::string_view prefix = "frame_";
    if (!name.starts_with(prefix) || !in_known_format()) return {};
    std::int64_t number = 0;
    const char* const end = name.data() + name.rfind('.');
    const auto [rest, error] = std::from_chars(name.data() + prefix.size(), end, number);
    return error == std::errc{} && rest == end ? std::optional(number) : std::nullopt;
  }

  std::string name;
  bool half = false;
};

/// Whether a file is of an earlier run.
bool is_result(const Name& file) {
  if (file.name == fault_file_name || file.name == collection_file_name || file.name == "scene.json" ||
      file.name == "summary.json")
    return true;
  return file.in_known_format() && (file.name.starts_with("frame_") || file.name.starts_with("solids."));
}

void remove_files(const fs::path& folder, const std::function<bool(const Name&)>& chosen) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (chosen(Name(entry.path().filename().string()))) files.push_back(entry.path());
  }
  for (const auto& file : files) {
    std::error_code error;
    if (!fs::remove(file, error) && error) {
      throw FileError(file.string() + ": cannot remove this result of an earlier run: " + error.message());
    }
  }
}

}  // namespace

const fs::path& fresh_folder(const fs::path& folder) {
  create_output_folder(folder);
  remove_surfaces(folder / surface_folder_name);
  remove_checkpoints(folder);
  remove_fault_dump(folder / fault_folder_name);
  remove_files(folder, is_result);
  return folder;
}

const fs::path& rewound_folder(const fs::path& folder, const SessionState& state, std::int64_t step) {
  create_output_folder(folder);
  remove_checkpoints(folder, step);  // before the files that they would go on with
  remove_fault_dump(folder / fault_folder_name);
  if (const fs::path collection = folder / collection_file_name; fs::exists(collection)) {
    write_whole(collection, encode_collection(state.frame_times));
  }
  const auto frames = static_cast<std::int64_t>(state.frame_times.size());
  remove_files(folder, [&](const Name& file) {
    if (file.name == "summary.json" || file.name == fault_file_name || (file.half && is_result(file))) return true;
    return file.frame().value_or(-1) >= frames;
  });
  return folder;
}

}  // namespace sessile::app
