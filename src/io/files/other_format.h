#pragma once
// What a file is that should be OBJ or MTL and begins like a file of another kind.

#include <string_view>

namespace hemilux {

/// "a gzip archive; unpack it first" and the like; empty where nothing is recognized.
[[nodiscard]] std::string_view other_format(std::string_view content);

} // namespace hemilux
