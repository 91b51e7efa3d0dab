#include "sessile/scene/fault_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "sessile/core/error.h"

namespace sessile {

namespace {
constexpr std::size_t most_lines = 100;    // that people would read
constexpr std::size_t longest_path = 300;  // letters of an override that are told
}  // namespace

std::string around(const std::string& path) {
  const auto cut = path.find_last_of(".[");
  return cut == std::string::npos ? "" : path.substr(0, cut);
}

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

Json::Value parsed_or_thrown(SceneText& text, const std::filesystem::path& file) {
  if (auto root = text.parse()) return std::move(*root);
  std::vector<std::string> messages;
  for (const auto& error : text.errors()) {
    messages.push_back(fmt::format("{}:{}: {}", file.string(), error.line, error.message));
  }
  throw SceneError(std::move(messages));
}

std::string FaultLines::place(std::ptrdiff_t offset) const {
  if (offset < 0) {
    const std::string& path = overrides_[static_cast<std::size_t>(-offset - 1)].path;
    return "--set " + (path.size() > longest_path ? path.substr(0, longest_path) + "..." : path);
  }
  return fmt::format("{}:{}", file_, text_.line(offset));
}

void FaultLines::add(std::ptrdiff_t offset, const std::string& path, const std::string& message) {
  const std::ptrdiff_t after_file = std::numeric_limits<std::ptrdiff_t>::max() / 2;
  lines_.emplace_back(offset < 0 ? after_file - offset : offset, line_for(place(offset), path, message));
  // A choice that was not understood spoils all of what was chosen.
  paths_.push_back(path.ends_with(".type") ? around(path) : path);
}

void FaultLines::add_repeated_keys() {
  for (const auto& each : text_.repeated_keys()) {
    add(each.offset, each.path, fmt::format("given twice (first on line {})", text_.line(each.first)));
  }
}

bool FaultLines::spoils(const Fault& fault) const {
  const auto spoilt = [&](const std::string& path) {
    return !path.empty() && std::any_of(paths_.begin(), paths_.end(),
                                        [&](const auto& each) { return !each.empty() && touches(each, path); });
  };
  return spoilt(fault.path) || std::any_of(fault.uses.begin(), fault.uses.end(), spoilt);
}

void FaultLines::throw_any() {
  if (lines_.empty()) return;
  std::stable_sort(lines_.begin(), lines_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> messages;
  for (std::size_t i = 0; i < std::min(lines_.size(), most_lines); ++i) messages.push_back(std::move(lines_[i].second));
  if (lines_.size() > most_lines) messages.push_back(fmt::format("{}: more than {} faults", file_, most_lines));
  throw SceneError(std::move(messages));
}

}  // namespace sessile
