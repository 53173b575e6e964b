#pragma once
// The compressor of stb_image_write, for other formats than its own.

#include <string>
#include <vector>

namespace hemilux {

/// The bytes as a zlib stream (RFC 1950). Throws std::bad_alloc.
[[nodiscard]] std::string zlib_compressed(std::vector<unsigned char> bytes);

} // namespace hemilux
