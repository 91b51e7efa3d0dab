#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sessile {

/// Text of a JSON object, its lines in the order they are added; jsoncpp's own would sort them and print 0.1 with 17
/// digits. `depth` is how deep the object stands in others.
class JsonObject {
 public:
  explicit JsonObject(std::size_t depth) : indent_(2 * depth, ' ') {}

  JsonObject& add(std::string_view key, double value);  ///< null when it is not finite
  JsonObject& add(std::string_view key, std::int64_t value);
  JsonObject& add(std::string_view key, std::size_t value);
  JsonObject& add(std::string_view key, bool value);
  JsonObject& add(std::string_view key, const std::string& text);
  JsonObject& add(std::string_view key, const char* text) { return add(key, std::string(text)); }
  JsonObject& raw(std::string_view key, std::string_view json);
  std::string text() const;

 private:
  std::string indent_;
  std::string text_;
};

/// The text with all its lines but the first moved in by two blanks, so that it reads well inside an object.
std::string indented(std::string_view text);

}  // namespace sessile
