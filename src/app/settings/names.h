#pragma once
// Names that a user typed: which of the known ones was meant?

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

/// The number of insertions, deletions and replacements that turn one word into the other
/// (Levenshtein 1966).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name that begins with the word, else the one with the smallest distance, if that is at
/// most half of the word; else empty.
[[nodiscard]] std::string nearest_name(std::string_view word, std::span<const std::string> known);

/// A list such as "a, b, c and 5 more".
[[nodiscard]] std::string list_names(std::span<const std::string> names, std::size_t most = 8);

/// "unknown material 'lihgt'; did you mean 'light'?" or, where none is near, the list of all.
[[nodiscard]] std::string unknown_name(std::string_view kind, std::string_view word,
                                       std::span<const std::string> known);

} // namespace hemilux
