#include "sessile/results/results.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <string_view>
#include <system_error>
#include <utility>

#include "sessile/core/error.h"
#include "sessile/core/memory_limit.h"
#include "sessile/results/frame_files.h"
#include "sessile/scene/json_text.h"
#include "sessile/scene/read.h"

namespace sessile {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 2> readable_formats{"vtp", "ply"};  // what can be read, the preferred first
constexpr std::uintmax_t largest_collection = std::uintmax_t{128} << 20;   // a million frames take 70 MiB
constexpr std::uintmax_t largest_summary = std::uintmax_t{16} << 20;
constexpr std::size_t head_bytes = 4096;  // enough for the time, which stands in front

/// A frame's bytes and what is made of them must both fit.
std::uintmax_t largest_frame() { return static_cast<std::uintmax_t>(memory_limit().bytes / 4); }

/// The number in frame_000012.vtp; nothing for other names.
std::optional<std::int64_t> number_of(const std::string& name, std::string_view format) {
  constexpr std::string_view prefix = "frame_";
  const std::string suffix = fmt::format(".{}", format);
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return {};
  const char *const begin = name.data() + prefix.size(), *const end = name.data() + name.size() - suffix.size();
  std::int64_t number = -1;
  const auto [rest, error] = std::from_chars(begin, end, number);
  if (begin >= end || error != std::errc{} || rest != end || number < 0) return {};
  return number;
}

std::vector<ResultFrame> frames_in(const fs::path& folder, std::string_view format) {
  std::vector<ResultFrame> frames;
  std::error_code error;
  const fs::directory_iterator entries(folder, error);
  if (error) throw FileError(fmt::format("cannot open the results in {}: {}", folder.string(), error.message()));
  for (const auto& entry : entries) {
    const auto number = number_of(entry.path().filename().string(), format);
    if (number) frames.push_back({*number, 0, entry.path()});
  }
  std::sort(frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  return frames;
}

/// Whether there is no more in it than in the collection of a million frames: one tag a frame with three attributes. A
/// tree of XML takes up to a hundred bytes for each.
bool is_collection_of_ours(std::string_view bytes) {
  constexpr std::ptrdiff_t most_tags = 1'100'000, most_attributes = 4'000'000;
  return std::count(bytes.begin(), bytes.end(), '<') <= most_tags &&
         std::count(bytes.begin(), bytes.end(), '=') <= most_attributes;
}

/// The times that frames.pvd gives to files; none where there is no such file or it is damaged.
std::map<std::string, double, std::less<>> collected_times(const fs::path& folder) {
  std::map<std::string, double, std::less<>> times;
  std::string bytes;
  pugi::xml_document document;
  try {
    bytes = file_bytes(folder / "frames.pvd", largest_collection);
    if (!is_collection_of_ours(bytes)) return times;
    if (!document.load_buffer_inplace(bytes.data(), bytes.size())) return times;
  } catch (const FileError&) {
    return times;
  }
  for (const pugi::xml_node entry : document.child("VTKFile").child("Collection").children("DataSet")) {
    const std::string_view text = entry.attribute("timestep").value();
    double time = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), time);
    if (error == std::errc{} && rest == text.data() + text.size() && std::isfinite(time)) {
      times.emplace(entry.attribute("file").value(), time);
    }
  }
  return times;
}

double time_of(const fs::path& file) {
  const std::string head = first_bytes(file, head_bytes);
  const auto moment = file.extension() == ".ply" ? ply_moment(head) : vtp_moment(head);
  if (!moment) throw FileError(fmt::format("cannot read {}: it tells no time, so it is no frame", file.string()));
  return moment->time;
}

/// The scene as the text of a file of its own, out of the summary of an older run.
std::string scene_in_summary(const fs::path& file) {
  const std::string text = file_bytes(file, largest_summary);
  const auto summary = parsed_json(text);
  if (!summary || !summary->isObject() || !(*summary)["scene"].isObject()) {
    throw FileError(fmt::format("cannot read {}: it holds no scene", file.string()));
  }
  return Json::writeString(Json::StreamWriterBuilder(), (*summary)["scene"]);
}

}  // namespace

ResolvedScene read_resolved_result(const fs::path& folder, std::span<const std::string> overrides) {
  std::error_code ignored;
  const fs::path own = folder / "scene.json", summary = folder / "summary.json";
  // A run writes down where it found its meshes.
  if (fs::exists(own, ignored)) return read_resolved_scene(own, overrides, {}, MeshPlaces::anywhere);
  if (fs::exists(summary, ignored)) {
    return read_resolved_text(scene_in_summary(summary), summary.string(), overrides);
  }
  throw FileError(
      fmt::format("{} holds neither scene.json nor summary.json: is it a folder of `sessile run`?", folder.string()));
}

Scene read_result_scene(const fs::path& folder) {
  try {
    return read_resolved_result(folder).scene;
  } catch (const SceneError& e) {
    throw FileError(fmt::format("the scene of {} cannot be used: {}", folder.string(), e.what()));
  }
}

Results open_results(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    const std::string why = error ? error.message() : "it is no folder";
    throw FileError(fmt::format("cannot open the results in {}: {}", folder.string(), why));
  }
  Results results{folder, read_result_scene(folder), {}};
  for (const std::string_view format : readable_formats) {
    if (results.frames.empty()) results.frames = frames_in(folder, format);
  }
  if (results.frames.empty()) {
    throw FileError(fmt::format(
        "{} holds no frames (frame_000000.vtp ...): did the scene's output.formats ask for any?", folder.string()));
  }
  const auto times = collected_times(folder);
  for (ResultFrame& frame : results.frames) {
    const auto known = times.find(frame.file.filename().string());
    frame.time = known != times.end() ? known->second : time_of(frame.file);
  }
  return results;
}

Snapshot read_frame(const fs::path& file) {
  std::string bytes = file_bytes(file, largest_frame());
  try {
    if (file.extension() == ".ply") return parse_ply_frame(bytes);
    if (file.extension() == ".vtp") return parse_vtp_frame(std::move(bytes));
  } catch (const FileError& fault) {
    throw FileError(fmt::format("cannot read {}: {}", file.string(), fault.what()));
  }
  throw FileError(fmt::format("cannot read {}: frames are .vtp or .ply files", file.string()));
}

const ResultFrame& frame_at(const Results& results, double time) {
  return *std::min_element(results.frames.begin(), results.frames.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.time - time) < std::abs(b.time - time);
  });
}

}  // namespace sessile
