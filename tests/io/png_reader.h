#pragma once
// Decodes the PNG files that are written here, and only those: 8-bit RGB, not interlaced.

#include <cstdint>
#include <string>
#include <vector>

namespace hemilux::test {

struct Png {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bytes; ///< RGB, row by row from the top
};

/// The content of a zlib stream as stb_image_write makes it: without codes of its own.
std::vector<std::uint8_t> unzipped(const std::vector<std::uint8_t>& stream);

/// Throws std::runtime_error for anything unexpected.
Png read_png(const std::string& path);

} // namespace hemilux::test
