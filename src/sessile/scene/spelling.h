#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace sessile {

/// Number of letters to insert, drop, change or swap with their neighbour to make one word of the other; case is free.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate that `word` was probably meant to be, or an empty view when none is near.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// A hint for a word that is none of the candidates: ` (did you mean "cohesion"?)` or ` (valid keys: a, b)`, where
/// `kind` is the plural of what was expected ("keys").
std::string spelling_hint(std::string_view word, std::span<const std::string_view> candidates, std::string_view kind);

/// Text of a file as it may stand in a message: control characters replaced, which a terminal would obey, cut when
/// long.
std::string printable(std::string_view text);

/// The same in quotes.
std::string in_quotes(std::string_view text);

}  // namespace sessile
