#include "sessile/scene/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "sessile/core/error.h"
#include "sessile/scene/overrides.h"
#include "sessile/scene/read_values.h"
#include "sessile/scene/scene_text.h"
#include "sessile/scene/validate.h"

namespace sessile {

namespace {

/// Offsets below zero stand for overrides: -1 is the first.
std::ptrdiff_t mark_of(std::size_t override_index) { return -static_cast<std::ptrdiff_t>(override_index) - 1; }

/// The path of the group or list around a path; "" around the outermost.
std::string around(const std::string& path) {
  const auto cut = path.find_last_of(".[");
  return cut == std::string::npos ? "" : path.substr(0, cut);
}

/// Whether one path is the other or a part of it.
bool touches(const std::string& a, const std::string& b) {
  const auto& longer = a.size() < b.size() ? b : a;
  const auto& shorter = a.size() < b.size() ? a : b;
  if (!longer.starts_with(shorter)) return false;
  return longer.size() == shorter.size() || longer[shorter.size()] == '.' || longer[shorter.size()] == '[';
}

std::string line_for(const std::string& place, const std::string& path, const std::string& message) {
  constexpr std::string_view set = "--set ";
  const bool named = path.empty() || (place.starts_with(set) && place.substr(set.size()) == path);
  return place + ": " + (named ? "" : path + ": ") + message;
}

/// Lines in the order of the file, then of the overrides.
class FaultLines {
 public:
  FaultLines(std::string file, const SceneText& text, std::span<const Override> overrides)
      : file_(std::move(file)), text_(text), overrides_(overrides) {}

  std::string place(std::ptrdiff_t offset) const {
    if (offset < 0) return "--set " + overrides_[static_cast<std::size_t>(-offset - 1)].path;
    return fmt::format("{}:{}", file_, text_.line(offset));
  }

  void add(std::ptrdiff_t offset, const std::string& path, const std::string& message) {
    const std::ptrdiff_t after_file = std::numeric_limits<std::ptrdiff_t>::max() / 2;
    lines_.emplace_back(offset < 0 ? after_file - offset : offset, line_for(place(offset), path, message));
    // A choice that was not understood spoils all of what was chosen.
    paths_.push_back(path.ends_with(".type") ? around(path) : path);
  }

  /// Whether a fault was found in one of the parameters that this judgement rests on.
  bool spoils(const Fault& fault) const {
    const auto spoilt = [&](const std::string& path) {
      return !path.empty() && std::any_of(paths_.begin(), paths_.end(),
                                          [&](const auto& each) { return !each.empty() && touches(each, path); });
    };
    return spoilt(fault.path) || std::any_of(fault.uses.begin(), fault.uses.end(), spoilt);
  }

  void throw_any() {
    if (lines_.empty()) return;
    std::stable_sort(lines_.begin(), lines_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> messages;
    for (auto& line : lines_) messages.push_back(std::move(line.second));
    throw SceneError(std::move(messages));
  }

 private:
  std::string file_;
  const SceneText& text_;
  std::span<const Override> overrides_;
  std::vector<std::pair<std::ptrdiff_t, std::string>> lines_;
  std::vector<std::string> paths_;
};

}  // namespace

std::string ResolvedScene::locate(const Fault& fault) const {
  std::string path = fault.path;
  while (!path.empty() && !places.contains(path)) path = around(path);
  const auto place = places.find(path);
  return place == places.end() ? text(fault) : line_for(place->second, fault.path, fault.message);
}

ResolvedScene read_resolved_scene(const std::filesystem::path& file, std::span<const std::string> overrides,
                                  const FurtherCheck& further) {
  SceneText text = SceneText::from_file(file);
  auto root = text.parse();
  if (!root) {
    std::vector<std::string> messages;
    for (const auto& error : text.errors()) {
      messages.push_back(fmt::format("{}:{}: {}", file.string(), error.line, error.message));
    }
    throw SceneError(std::move(messages));
  }

  std::vector<Override> split;
  for (const auto& each : overrides) split.push_back(split_override(each));
  FaultLines lines(file.string(), text, split);
  for (const auto& each : text.repeated_keys()) {
    lines.add(each.offset, each.path, fmt::format("given twice (first on line {})", text.line(each.first)));
  }
  for (std::size_t i = 0; i < split.size(); ++i) {
    const Fault fault = apply_override(split[i], mark_of(i), *root);
    if (!fault.message.empty()) lines.add(mark_of(i), fault.path, fault.message);
  }

  ResolvedScene resolved;
  ValueReader reader(text, std::filesystem::absolute(file).parent_path());
  reader.read(*root, "", any_number, "", resolved.scene);
  for (const auto& found : reader.faults()) lines.add(found.offset, found.path, found.message);
  resolved.given = reader.given();
  for (const auto& [path, offset] : reader.offsets()) resolved.places.emplace(path, lines.place(offset));

  // What the parts make together, unless one of those parts is at fault already.
  if (root->isObject()) {
    auto together = validate(resolved.scene);
    if (further) std::ranges::move(further(resolved.scene), std::back_inserter(together));
    std::erase_if(together, [&](const Fault& fault) { return lines.spoils(fault); });
    for (const auto& fault : together) {
      std::string path = fault.path;
      while (!path.empty() && !reader.offsets().contains(path)) path = around(path);
      lines.add(reader.offsets().at(path), fault.path, fault.message);
    }
  }
  lines.throw_any();
  return resolved;
}

Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read_resolved_scene(file, overrides).scene;
}

}  // namespace sessile
