#pragma once
// This recognizes a file that should be OBJ or MTL but begins like a file of another kind.

#include <string_view>

namespace hemilux {

/// Returns a phrase such as "a zip archive; unpack it first"; empty if no format is recognized.
[[nodiscard]] std::string_view other_format(std::string_view content);

} // namespace hemilux
