#pragma once
// Words, names and numbers of a line of text, and lists of names. Nothing here depends on the
// locale.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

/// Numbers of a scene beyond this are refused: their products must stay finite.
inline constexpr double largest_number = 1e100;

/// The text without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// What stands between separators; of an empty text one empty part.
[[nodiscard]] std::vector<std::string_view> parts_of(std::string_view text, char separator);
/// Takes the next word from the front of the text; empty at the end of the line or at a comment.
std::string_view take_word(std::string_view& text);
/// The text with the letters A to Z made small.
[[nodiscard]] std::string small_letters(std::string_view text);
/// Whether both are the same but for capitals, and not the same.
[[nodiscard]] bool differ_in_case(std::string_view a, std::string_view b);
/// All of the text up to a comment. Names may have a # in them: a comment begins with a # after a
/// blank, and a digit does not follow ("Material #25" is a name).
[[nodiscard]] std::string_view name_in(std::string_view text);

/// A list such as "a, b, c and 5 more".
[[nodiscard]] std::string list_names(std::span<const std::string> names, std::size_t most = 8);

/// Reads a decimal number with a point; one too small for a double is 0. Empty for anything else,
/// such as nan, inf, hexadecimal or a number beyond `largest_number`.
[[nodiscard]] std::optional<double> parse_decimal(std::string_view word);
/// For messages: at most `longest` bytes of the text, and "..." where it is longer.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t longest);
/// Words for error messages: `found "x"`, shortened and printable, or `found the end of the line`.
[[nodiscard]] std::string found_instead(std::string_view word);
/// The same with a hint about usual mistakes in numbers.
[[nodiscard]] std::string found_instead_of_number(std::string_view word);

} // namespace hemilux
