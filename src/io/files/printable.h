#pragma once
// Text of unknown origin, such as a name from a file, made fit for a terminal or an XML file.

#include <string>
#include <string_view>

namespace hemilux {

/// Keeps printable UTF-8 as it is, line feeds and tabs too. The rest becomes U+FFFD, a visible
/// mark. Control characters are part of it, as escape sequences begin with one, or with one of C1.
/// So are marks that turn the direction of writing or end a line unseen, and every byte that is not
/// valid UTF-8.
[[nodiscard]] std::string printable(std::string_view text);

/// Returns a name or a path as part of one line: line ends, tabs and other control characters of
/// ASCII become U+FFFD, so that no name looks like a message of its own.
[[nodiscard]] std::string single_line(std::string_view text);

/// Does the same as printable() for a message, and leaves out the middle of each line that is
/// longer than a thousand bytes.
[[nodiscard]] std::string printable_message(std::string_view text);

} // namespace hemilux
