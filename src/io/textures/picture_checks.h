#pragma once
// This checks what stb_image of 2022 takes on trust from a file, before it reads the file.

#include <string>
#include <string_view>

namespace hemilux {

/// Throws InputError, in the name of `place`, for a PNG file with a chunk longer than the file, for
/// which stb_image would allocate memory. Throws it too for a JPEG file with a Huffman table of
/// more than 256 codes, which stb_image would write beyond its own table. A JPEG file with very
/// many scans is refused as well, as each scan takes as long as the claimed size.
void check_picture(std::string_view bytes, const std::string& place);

inline constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n", jpeg_signature = "\xff\xd8";

} // namespace hemilux
