#include "sessile/scene/json_text.h"

#include <json/reader.h>

#include <memory>

namespace sessile {
namespace {

constexpr std::size_t deepest = 64;

/// Every value but the first comes after a comma or the start of a group or list.
bool within_limits(std::string_view text, std::size_t most) {
  std::size_t level = 0, values = 1;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"') {
      for (++at; at < text.size() && text[at] != '"'; ++at) at += text[at] == '\\' ? 1U : 0U;
    } else if (c == '{' || c == '[' || c == ',') {
      if (++values > most) return false;
      if (c != ',' && ++level > deepest) return false;
    } else if ((c == '}' || c == ']') && level > 0) {
      --level;
    }
  }
  return true;
}

}  // namespace

std::optional<Json::Value> parsed_json(std::string_view text, std::size_t most) {
  if (!within_limits(text, most)) return std::nullopt;
  Json::CharReaderBuilder builder;
  builder["allowComments"] = false;  // quotation marks in them would hide values from the count
  builder["collectComments"] = false;
  builder["stackLimit"] = static_cast<int>(2 * deepest);
  const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
  Json::Value value;
  try {
    if (!reader->parse(text.data(), text.data() + text.size(), &value, nullptr)) return std::nullopt;
  } catch (const Json::Exception&) {
    return std::nullopt;
  }
  return value;
}

}  // namespace sessile
