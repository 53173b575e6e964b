#pragma once
// Words, names and numbers of a line of text. Nothing here depends on the locale.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

/// Numbers of a scene beyond this are refused: their products must stay finite.
inline constexpr double largest_number = 1e100;

/// Returns the text without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// Returns the parts between separators; an empty text has one empty part.
[[nodiscard]] std::vector<std::string_view> parts_of(std::string_view text, char separator);
/// Takes the next word from the front of the text; empty at the end of the line or at a comment.
std::string_view take_word(std::string_view& text);
/// Returns the text with the letters A to Z made small.
[[nodiscard]] std::string small_letters(std::string_view text);
/// Returns whether the texts differ, but in capitals only.
[[nodiscard]] bool differ_in_case(std::string_view a, std::string_view b);
/// Returns all of the text up to a comment. Names may have a # in them: a comment begins with a #
/// after a blank, unless a digit follows ("Material #25" is a name).
[[nodiscard]] std::string_view name_in(std::string_view text);

/// Reads a decimal number with a point; one too small for a double is 0. The result is empty for
/// anything else, such as nan, inf, hexadecimal or a number beyond `largest_number`.
[[nodiscard]] std::optional<double> parse_decimal(std::string_view word);
/// Returns for messages at most `longest` bytes of the text, and "..." where it is longer.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t longest);
/// Returns words for error messages: `found "x"`, shortened and printable, or `found the end of the
/// line`.
[[nodiscard]] std::string found_instead(std::string_view word);
/// Returns the same with a hint about usual mistakes in numbers.
[[nodiscard]] std::string found_instead_of_number(std::string_view word);

} // namespace hemilux
