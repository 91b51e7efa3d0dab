#include "sessile/scene/scene_text.h"

#include <fmt/format.h>
#include <json/reader.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <memory>
#include <system_error>
#include <utility>

#include "sessile/core/error.h"
#include "sessile/scene/input_file.h"

namespace sessile {

namespace {

constexpr std::size_t deepest_level = 64;
constexpr std::uintmax_t largest_scene = std::uintmax_t{16} << 20;
constexpr std::size_t most_values = 2'000'000;  // each takes some hundred bytes once read
constexpr std::size_t most_repeated = 100;      // that are told of

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Whether a bare word stands for a number that no double can hold.
bool is_not_finite(std::string_view word) {
  if (word.starts_with('-')) word.remove_prefix(1);
  for (const std::string_view name : {"NaN", "nan", "Infinity", "Inf", "inf"}) {
    if (word == name) return true;
  }
  if (word.empty() || word.front() < '0' || word.front() > '9') return false;
  double number = 0;
  const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc::result_out_of_range || rest != word.data() + word.size()) return false;
  // Too small is out of range as well; such a number is read as 0.
  const auto exponent = word.find_first_of("eE");
  return exponent == std::string_view::npos || word.substr(exponent).find('-') == std::string_view::npos;
}

}  // namespace

/// A group or list that the scan is inside of.
struct SceneText::Level {
  bool group = false;
  std::size_t index = 0;
  std::string key;
  std::map<std::string, std::ptrdiff_t> seen;
};

SceneText::SceneText(std::string text) : text_(std::move(text)) {
  // Windows editors put a mark at the start.
  if (text_.starts_with("\xEF\xBB\xBF")) text_.replace(0, 3, "   ");
  line_starts_.push_back(0);
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\n') line_starts_.push_back(i + 1);
  }
  scan();
}

SceneText SceneText::from_file(const std::filesystem::path& file) {
  const auto cannot = [&](const std::string& why) { return SceneError(file.string() + ": cannot be read: " + why); };
  std::string text;
  try {
    text = read_input(file, largest_scene, Input::file_or_pipe);
  } catch (const FileError& fault) {
    throw cannot(fault.what());
  }
  if (text.find('\0') != std::string::npos) throw cannot("it is no text file");
  return SceneText(std::move(text));
}

std::optional<Json::Value> SceneText::parse() {
  if (!errors_.empty()) return std::nullopt;
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);
  builder["allowComments"] = true;
  builder["collectComments"] = false;
  builder["strictRoot"] = false;     // a scene that is no group is told so with the rest
  builder["rejectDupKeys"] = false;  // the scan tells of them, and reading goes on
  builder["stackLimit"] = static_cast<int>(2 * deepest_level);
  const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
  Json::Value root;
  std::string report;
  try {
    if (reader->parse(text_.data(), text_.data() + text_.size(), &root, &report)) return root;
  } catch (const Json::Exception& exception) {
    errors_.push_back({1, exception.what()});
    return std::nullopt;
  }
  // The report is "* Line 3, Column 5\n  what\n" for each error, with hints between.
  int line = 1;
  for (std::size_t at = 0; at < report.size();) {
    const std::size_t end = std::min(report.find('\n', at), report.size());
    const std::string_view row(report.data() + at, end - at);
    constexpr std::string_view mark = "* Line ";
    if (row.starts_with(mark)) {
      std::from_chars(row.data() + mark.size(), row.data() + row.size(), line);
    } else if (row.starts_with("  ") && row.size() > 2) {
      std::string message(row.substr(2));
      if (message.ends_with('.')) message.pop_back();
      // After a first error the parser stops in the middle and then finds the rest of the text too much.
      if (errors_.empty() || !message.starts_with("Extra")) errors_.push_back({line, message});
    }
    at = end + 1;
  }
  if (errors_.empty()) errors_.push_back({1, "no JSON"});
  return std::nullopt;
}

std::optional<std::string> SceneText::not_finite(std::ptrdiff_t offset) const {
  const auto found = not_finite_.find(offset);
  return found == not_finite_.end() ? std::nullopt : std::optional(found->second);
}

int SceneText::line(std::ptrdiff_t offset) const {
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), static_cast<std::size_t>(offset));
  return static_cast<int>(after - line_starts_.begin());
}

std::ptrdiff_t SceneText::key_offset(std::ptrdiff_t value_offset) const {
  const auto found = key_of_value_.find(value_offset);
  return found == key_of_value_.end() ? value_offset : found->second;
}

std::size_t SceneText::skip_comment(std::size_t at) const {
  const bool block = text_.compare(at, 2, "/*") == 0;
  if (!block && text_.compare(at, 2, "//") != 0) return at;
  const std::size_t end = block ? text_.find("*/", at + 2) : text_.find('\n', at);
  return end == std::string::npos ? text_.size() : end + (block ? 2 : 0);
}

std::string SceneText::path_of(const std::vector<Level>& levels) {
  std::string path;
  for (const auto& level : levels) {
    if (level.group) {
      path += (path.empty() ? "" : ".") + level.key;
    } else {
      path += fmt::format("[{}]", level.index);
    }
  }
  return path;
}

void SceneText::scan_word(std::size_t begin, std::size_t end) {
  const std::string word = text_.substr(begin, end - begin);
  if (!is_not_finite(word)) return;
  // The parser would stop here without naming the key. It reads a 0 instead, and whoever reads the value asks us.
  not_finite_.emplace(begin, word);
  std::fill(text_.begin() + static_cast<std::ptrdiff_t>(begin), text_.begin() + static_cast<std::ptrdiff_t>(end), ' ');
  text_[begin] = '0';
}

void SceneText::scan() {
  std::vector<Level> levels;
  std::ptrdiff_t key = -1;  // offset of the key whose value comes next
  std::size_t values = 0;
  const auto value_starts = [&](std::size_t at) {
    ++values;
    if (key >= 0) key_of_value_.emplace(at, key);
    key = -1;
  };
  for (std::size_t at = 0; at < text_.size();) {
    const char c = text_[at];
    if (values > most_values) {
      errors_.push_back({line(static_cast<std::ptrdiff_t>(at)), fmt::format("holds more than {} values", most_values)});
      return;
    }
    if (const std::size_t after = c == '/' ? skip_comment(at) : at; after != at) {
      at = after;
    } else if (c == '"') {
      std::size_t end = at + 1;
      while (end < text_.size() && text_[end] != '"') end += text_[end] == '\\' ? 2U : 1U;
      end = std::min(end, text_.size());
      std::size_t next = end + 1;
      while (next < text_.size() && (is_space(text_[next]) || skip_comment(next) != next)) {
        next = is_space(text_[next]) ? next + 1 : skip_comment(next);
      }
      if (!levels.empty() && levels.back().group && next < text_.size() && text_[next] == ':') {
        auto& level = levels.back();
        level.key = text_.substr(at + 1, end - at - 1);
        const auto offset = static_cast<std::ptrdiff_t>(at);
        const auto [first, fresh] = level.seen.emplace(level.key, offset);
        if (!fresh && repeated_keys_.size() < most_repeated)
          repeated_keys_.push_back({offset, first->second, path_of(levels)});
        key = offset;
        at = next + 1;
      } else {
        value_starts(at);
        at = end + 1;
      }
    } else if (c == '{' || c == '[') {
      value_starts(at);
      if (levels.size() == deepest_level) {
        errors_.push_back(
            {line(static_cast<std::ptrdiff_t>(at)), fmt::format("nested more than {} levels deep", deepest_level)});
        return;
      }
      levels.emplace_back().group = c == '{';
      ++at;
    } else if (c == '}' || c == ']') {
      if (!levels.empty()) levels.pop_back();
      ++at;
    } else if (c == ',' || c == ':' || is_space(c)) {
      if (c == ',' && !levels.empty()) ++levels.back().index;
      ++at;
    } else {
      std::size_t end = at + 1;
      while (end < text_.size() && !is_space(text_[end]) && std::strchr(",:{}[]\"/", text_[end]) == nullptr) ++end;
      value_starts(at);
      scan_word(at, end);
      at = end;
    }
  }
}

}  // namespace sessile
