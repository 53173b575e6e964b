#pragma once
// What a file is that should be OBJ or MTL and begins like a file of another kind.

#include <string_view>

namespace hemilux {

/// A phrase such as "a gzip archive; unpack it first"; empty if no format is recognized.
[[nodiscard]] std::string_view other_format(std::string_view content);

} // namespace hemilux
