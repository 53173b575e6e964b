#pragma once
// The names that a user typed, and which of the known ones was meant.

#include <cstddef>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

/// Returns the number of insertions, deletions and replacements that turn one word into the other
/// (Levenshtein 1966).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the known name that begins with the word, else the one with the smallest distance, if
/// that is at most half of the word; else empty.
[[nodiscard]] std::string nearest_name(std::string_view word, std::span<const std::string> known);

/// Returns the words with `between` between them, and `last` before the last one.
template <class Words>
[[nodiscard]] std::string joined(const Words& words, std::string_view between,
                                 std::string_view last) {
    std::string text;
    std::size_t left = std::size(words);
    for (const std::string_view word : words) {
        text += word;
        if (--left > 0)
            text += left == 1 ? last : between;
    }
    return text;
}
template <class Words>
[[nodiscard]] std::string joined(const Words& words, std::string_view between) {
    return joined(words, between, between);
}

/// Returns "unknown material 'lihgt'; did you mean 'light'?" or, where none is near, the list of
/// all.
[[nodiscard]] std::string unknown_name(std::string_view kind, std::string_view word,
                                       std::span<const std::string> known);

} // namespace hemilux
