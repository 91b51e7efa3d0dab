#pragma once

#include <json/value.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "sessile/scene/fault.h"

namespace sessile {

/// One `path=value` of `--set`.
struct Override {
  std::string path;
  std::optional<std::string> value;
};

/// Cuts `path=value`; without a '=' there is no value.
Override split_override(std::string_view text);

/// Puts an override's value, read as JSON or else taken as a text, into a scene's JSON tree. Groups on the way that
/// are missing are made; the index after the last of a list makes an entry. Every value that it makes gets the offset
/// `mark`. Returns a fault without a message when all went well.
Fault apply_override(const Override& override_, std::ptrdiff_t mark, Json::Value& root);

}  // namespace sessile
