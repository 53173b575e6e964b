#pragma once
// Words of commands that the program prints.

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace hemilux {

/// Returns a word as a shell takes it.
[[nodiscard]] inline std::string shell_word(const std::string& word) {
    const auto is_plain = [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view("_./:=,+-%@").find(static_cast<char>(c)) != std::string_view::npos;
    };
    if (!word.empty() && std::ranges::all_of(word, is_plain))
        return word;
    std::string text = "'";
    for (const char c : word)
        text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

} // namespace hemilux
