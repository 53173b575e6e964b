#pragma once
// What is said on stderr, as far as the user wants to hear it.

#include "app/settings/settings.h"

#include <string>
#include <vector>

namespace hemilux {

/// Waits until stderr takes a line. False once the user asked the program to end and nobody reads:
/// what there is to say is then lost.
[[nodiscard]] bool can_say();

/// Says a line unless the user wants less talk than `least`.
void say(Talk wanted, Talk least, const std::string& line);

/// Warnings of a reader: the first few, or all with -v.
void say_warnings(Talk wanted, const std::vector<std::string>& warnings);

} // namespace hemilux
