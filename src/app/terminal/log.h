#pragma once
// What is said on stderr, as far as the user wants to hear it.

#include "app/settings/settings.h"

#include <string>
#include <vector>

namespace hemilux {

/// Waits until stderr takes a line. False once the user asked the program to end and nobody reads:
/// what there is to say is then lost.
[[nodiscard]] bool can_log();

/// Says a line unless the user asked for less than `least`.
void log_line(Verbosity wanted, Verbosity least, const std::string& line);

/// Warnings of a reader: the first few, or all with -v.
void log_warnings(Verbosity wanted, const std::vector<std::string>& warnings);

} // namespace hemilux
