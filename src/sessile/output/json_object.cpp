#include "sessile/output/json_object.h"

#include <fmt/format.h>
#include <json/writer.h>

#include <cmath>

namespace sessile {

JsonObject& JsonObject::add(std::string_view key, double value) {
  return raw(key, std::isfinite(value) ? fmt::format("{}", value) : "null");
}
JsonObject& JsonObject::add(std::string_view key, std::int64_t value) { return raw(key, fmt::format("{}", value)); }
JsonObject& JsonObject::add(std::string_view key, std::size_t value) { return raw(key, fmt::format("{}", value)); }
JsonObject& JsonObject::add(std::string_view key, bool value) { return raw(key, value ? "true" : "false"); }
JsonObject& JsonObject::add(std::string_view key, const std::string& text) {
  return raw(key, Json::valueToQuotedString(text.c_str()));
}

JsonObject& JsonObject::raw(std::string_view key, std::string_view json) {
  text_ += fmt::format("{}{}  \"{}\": {}", text_.empty() ? "{\n" : ",\n", indent_, key, json);
  return *this;
}

std::string JsonObject::text() const { return fmt::format("{}\n{}}}", text_.empty() ? "{" : text_, indent_); }

std::string indented(std::string_view text) {
  while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  std::string result;
  for (const char c : text) {
    result += c;
    if (c == '\n') result += "  ";
  }
  return result;
}

}  // namespace sessile
