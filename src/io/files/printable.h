#pragma once
// Text of unknown origin, such as a name from a file, made fit for a terminal or an XML file.

#include <string>
#include <string_view>

namespace hemilux {

/// Valid UTF-8 stays as it is, line feeds and tabs too. The rest becomes U+FFFD, a visible mark:
/// control characters (escape sequences begin with one, or with one of C1), marks that turn the
/// direction of writing or end a line unseen, and every byte that is not valid UTF-8.
[[nodiscard]] std::string printable(std::string_view text);

/// The same for a message: of a line that is longer than a thousand bytes the middle is left out.
[[nodiscard]] std::string printable_message(std::string_view text);

} // namespace hemilux
