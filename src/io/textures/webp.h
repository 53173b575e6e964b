#pragma once
// Pictures in WebP files, decoded by libwebp where hemilux was built with it.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

/// Returns whether the bytes begin like a WebP file and such files can be read here.
[[nodiscard]] bool is_readable_webp(std::string_view bytes);

struct WebpSize {
    int width, height;
};
/// Returns the size that the header states. `place` says for messages where the picture stands.
/// Throws InputError for a header that is broken.
[[nodiscard]] WebpSize webp_size(std::string_view bytes, const std::string& place);
/// Returns the texels of a picture of this size: three bytes each, row by row from the top. Alpha
/// is passed over. Throws InputError for a picture that is broken or moves.
[[nodiscard]] std::vector<std::uint8_t> decode_webp(std::string_view bytes, const WebpSize& size,
                                                    const std::string& place);

} // namespace hemilux
