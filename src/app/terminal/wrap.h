#pragma once
// Prose as a terminal shows it best: lines of at most 80 columns, broken at spaces.

#include <cstddef>
#include <string>
#include <string_view>

namespace hemilux {

/// Breaks lines of more than `width` columns at spaces; what follows a break begins with `indent`
/// spaces. Kept together are a number and what it counts, an option and its value, a name between
/// quotation marks, and runs of several spaces. So is the place that a message begins with, as in
/// "hemilux: my scenes/room.obj:3: expected ...". A word that is too long stays whole. A column is
/// a code point of UTF-8.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t width, std::size_t indent);

/// Returns the columns of the terminal that this descriptor leads to, 80 where it does not say; 0:
/// there is none.
[[nodiscard]] std::size_t terminal_columns(int descriptor);

/// Returns the text fit to be written to the descriptor: printable, and wrapped where that leads to
/// a terminal. A file or a pipe gets each message as one line, which programs can search.
[[nodiscard]] std::string message_for(int descriptor, std::string_view text,
                                      std::size_t indent = 2);

} // namespace hemilux
