#pragma once

#include <json/value.h>

#include <cstddef>
#include <optional>
#include <string_view>

namespace sessile {

/// Groups, lists and commas that a JSON text may have: as many values at most; each takes some hundred bytes once read.
inline constexpr std::size_t most_json_values = 2'000'000;

/// The value of a JSON text that a program is meant to have written, such as summary.json. Nothing where it is none, is
/// nested more than 64 levels deep, or holds more than `most` values: found out before memory is taken for them.
std::optional<Json::Value> parsed_json(std::string_view text, std::size_t most = most_json_values);

}  // namespace sessile
