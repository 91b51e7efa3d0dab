#pragma once

#include <json/value.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sessile/scene/fault.h"
#include "sessile/scene/overrides.h"
#include "sessile/scene/scene_text.h"

namespace sessile {

/// The path of the group or list around a path; "" around the outermost.
std::string around(const std::string& path);

/// Whether one path is the other or a part of it.
bool touches(const std::string& a, const std::string& b);

/// `tablet.json:12: forces[0].cohesion: message`; an override's place names the path already.
std::string line_for(const std::string& place, const std::string& path, const std::string& message);

/// The value that the text of a file stands for. Throws SceneError with every syntax error.
Json::Value parsed_or_thrown(SceneText& text, const std::filesystem::path& file);

/// Lines for people, in the order of the file, then of the overrides.
class FaultLines {
 public:
  FaultLines(std::string file, const SceneText& text, std::span<const Override> overrides)
      : file_(std::move(file)), text_(text), overrides_(overrides) {}

  /// `tablet.json:12`, or `--set time.end` for an offset below zero: -1 is the first override.
  std::string place(std::ptrdiff_t offset) const;

  void add(std::ptrdiff_t offset, const std::string& path, const std::string& message);
  void add_repeated_keys();

  /// Whether a fault was found in one of the parameters that this judgement rests on.
  bool spoils(const Fault& fault) const;

  /// Throws SceneError when there are any.
  void throw_any();

 private:
  std::string file_;
  const SceneText& text_;
  std::span<const Override> overrides_;
  std::vector<std::pair<std::ptrdiff_t, std::string>> lines_;
  std::vector<std::string> paths_;
};

}  // namespace sessile
