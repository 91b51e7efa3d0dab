#pragma once

#include <fmt/format.h>
#include <json/writer.h>

#include <string>
#include <type_traits>
#include <variant>

#include "sessile/core/vec.h"
#include "sessile/scene/traits.h"

namespace sessile {

/// Whether a field's value is a group, a choice of groups, or a list of such; everything else fits on a line.
template <class T>
inline constexpr bool is_group = Declared<T> || is_choice<T>;
template <class T>
inline constexpr bool is_group<std::optional<T>> = is_group<T>;
template <class T>
inline constexpr bool is_group<std::vector<T>> = is_group<T>;

/// A value on one line, as JSON; numbers with as many digits as bring them back exactly.
template <class T>
std::string value_text(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return fmt::format("{}", value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return Json::valueToQuotedString(value.c_str());
  } else if constexpr (std::is_same_v<T, Vec3d>) {
    return fmt::format("[{}, {}, {}]", value.x, value.y, value.z);
  } else if constexpr (Worded<T>) {
    return fmt::format("\"{}\"", word(value));
  } else if constexpr (is_optional<T>) {
    return value ? value_text(*value) : "null";
  } else if constexpr (is_list<T>) {
    std::string list;
    for (const auto& each : value) list += (list.empty() ? "" : ", ") + value_text(each);
    return fmt::format("[{}]", list);
  } else {
    static_assert(never<T>, "a kind of field that has no text");
  }
}

}  // namespace sessile
