#pragma once
// Texts on standard output for whoever reads them: help, what is known of a scene, a table.

#include <string>

namespace hemilux {

/// Writes a text to standard output. A reader that closes its pipe before the end, as `head` does,
/// has read enough: that is no error. Throws OutputError for any other failure.
void print(const std::string& text);

} // namespace hemilux
