#pragma once
// What is said of an option that there is not.

#include <span>
#include <string>
#include <string_view>

namespace hemilux {

/// Returns what takes the place of an option that an earlier version had; for other words what
/// unknown_name() returns. `word` may lack its dashes, as in a file of --config.
[[nodiscard]] std::string unknown_option(std::string_view word, std::span<const std::string> known);

} // namespace hemilux
