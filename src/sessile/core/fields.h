#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>

namespace sessile {

/// Values a number may take. Open at `low` when `above` is set: low < value instead of low <= value.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above = false;

  constexpr bool holds(double value) const { return (above ? value > low : value >= low) && value <= high; }
};

inline constexpr Range any_number{};
inline constexpr Range positive{0, std::numeric_limits<double>::infinity(), true};
inline constexpr Range non_negative{0};
constexpr Range at_least(double low) { return {low}; }
constexpr Range between(double low, double high) { return {low, high}; }

/// Whether a scene must give the field. A `derived` field is a std::optional whose absence means `Field::derived`.
enum class Presence { optional, required };

/// One declared parameter of a plain struct: the single source of its scene key, unit, range and help.
template <class Owner, class Type>
struct Field {
  using owner_type = Owner;
  using value_type = Type;

  Type Owner::*member;
  std::string_view key;
  std::string_view unit;  ///< SI unit; "" for a pure number, a word or a group
  Range range;
  std::string_view help;  ///< one line for people
  Presence presence = Presence::optional;
  std::string_view derived = "";  ///< what an absent std::optional stands for
};

/// Declares a field that has the default its struct gives it.
template <class Owner, class Type>
constexpr Field<Owner, Type> field(Type Owner::*member, std::string_view key, std::string_view unit, Range range,
                                   std::string_view help) {
  return {member, key, unit, range, help};
}

/// Declares a field without a number in it: a word, a text, a group, a list.
template <class Owner, class Type>
constexpr Field<Owner, Type> field(Type Owner::*member, std::string_view key, std::string_view help) {
  return {member, key, "", any_number, help};
}

/// Marks a field as one every scene must give.
template <class Owner, class Type>
constexpr Field<Owner, Type> required(Field<Owner, Type> f) {
  f.presence = Presence::required;
  return f;
}

/// Says what the absence of a std::optional field stands for.
template <class Owner, class Type>
constexpr Field<Owner, Type> derived(Field<Owner, Type> f, std::string_view meaning) {
  f.derived = meaning;
  return f;
}

/// A plain struct that declares its parameters: `static constexpr auto fields()` returns a tuple of Field.
template <class T>
concept Declared = requires {
  T::fields();
};

/// A declared struct that is one choice among several: its `name` is the value of the scene key "type".
template <class T>
concept Named = Declared<T> && requires {
  { T::name } -> std::convertible_to<std::string_view>;
  { T::summary } -> std::convertible_to<std::string_view>;
};

/// Calls f(field) for every declared field of T, in order.
template <Declared T, class F>
constexpr void for_each_field(F&& f) {
  std::apply([&](const auto&... each) { (f(each), ...); }, T::fields());
}

/// The words of an enumeration, in the order of its values 0, 1, 2 ...: specialise `words` beside the enum.
template <class Enum>
struct Words;  // specialisations hold: static constexpr std::array<std::string_view, N> words;

template <class T>
concept Worded = requires {
  Words<T>::words;
};

template <Worded Enum>
constexpr std::string_view word(Enum value) {
  return Words<Enum>::words[static_cast<std::size_t>(value)];
}

}  // namespace sessile
