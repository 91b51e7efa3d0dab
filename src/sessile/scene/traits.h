#pragma once

#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sessile/core/fields.h"

/// What kinds of types a declared field may have; everything that walks over declared fields asks these.
namespace sessile {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

template <class T>
inline constexpr bool is_choice = false;
template <class... Ts>
inline constexpr bool is_choice<std::variant<Ts...>> = true;

template <class T>
inline constexpr bool never = false;  // for static_assert in the last branch of an if constexpr

/// Calls f(std::type_identity<T>{}) for every alternative of a variant type.
template <class Choice, class F>
void for_each_alternative(F&& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (f(std::type_identity<std::variant_alternative_t<I, Choice>>{}), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Choice>>{});
}

/// The names of a variant's alternatives: the values of the key "type".
template <class Choice>
std::vector<std::string_view> alternative_names() {
  std::vector<std::string_view> names;
  for_each_alternative<Choice>([&]<Named T>(std::type_identity<T>) { names.push_back(T::name); });
  return names;
}

/// The name of the alternative that a choice holds.
std::string_view name_of(const auto& choice) {
  return std::visit([]<Named T>(const T&) -> std::string_view { return T::name; }, choice);
}

/// The keys of a declared struct.
template <Declared T>
std::vector<std::string_view> field_keys() {
  std::vector<std::string_view> keys;
  for_each_field<T>([&](const auto& f) { keys.push_back(f.key); });
  return keys;
}

}  // namespace sessile
