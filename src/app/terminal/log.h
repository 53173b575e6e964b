#pragma once
// The messages on stderr, as far as the user wants to see them.

#include "app/settings/settings.h"

#include <string>
#include <vector>

namespace hemilux {

/// Waits until stderr takes a line. False once the user has asked the program to end and nobody
/// reads: what there is to say is then lost.
[[nodiscard]] bool can_log();

/// Writes a text to stderr as lines that the terminal has room for.
void write_message(const std::string& text);

/// Logs a line unless the user asked for less than `least`.
void log_line(Verbosity wanted, Verbosity least, const std::string& line);

/// Logs what was done with a file in the same way: the path, which may have spaces, is not broken.
void log_path(Verbosity wanted, Verbosity least, const std::string& verb, const std::string& path);

/// Logs warnings: the first few, or all with -v.
void log_warnings(Verbosity wanted, const std::vector<std::string>& warnings);

} // namespace hemilux
