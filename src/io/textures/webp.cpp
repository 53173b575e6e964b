#include "io/textures/webp.h"

#include "io/files/error.h"

#include <algorithm>

#ifdef HEMILUX_WEBP
#include <webp/decode.h>
#endif

namespace hemilux {

#ifdef HEMILUX_WEBP

namespace {

const std::uint8_t* octets(std::string_view bytes) {
    return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

} // namespace

bool is_readable_webp(std::string_view bytes) {
    constexpr std::size_t kind = 8; // after RIFF and the length
    return bytes.starts_with("RIFF") &&
           bytes.substr(std::min(kind, bytes.size())).starts_with("WEBP");
}

WebpSize webp_size(std::string_view bytes, const std::string& place) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(octets(bytes), bytes.size(), &features) != VP8_STATUS_OK)
        throw InputError(place, "expected a WebP picture, its header is broken");
    if (features.has_animation != 0)
        throw InputError(place, "expected a WebP picture that does not move");
    return {features.width, features.height};
}

std::vector<std::uint8_t> decode_webp(std::string_view bytes, const WebpSize& size,
                                      const std::string& place) {
    constexpr std::size_t rgb = 3;
    const std::size_t row = rgb * static_cast<std::size_t>(size.width);
    std::vector<std::uint8_t> texels(row * static_cast<std::size_t>(size.height));
    if (WebPDecodeRGBInto(octets(bytes), bytes.size(), texels.data(), texels.size(),
                          static_cast<int>(row)) == nullptr)
        throw InputError(place, "expected a whole WebP picture");
    return texels;
}

#else

bool is_readable_webp(std::string_view) { return false; }

WebpSize webp_size(std::string_view, const std::string& place) {
    throw InputError(place, "hemilux was built without libwebp");
}

std::vector<std::uint8_t> decode_webp(std::string_view, const WebpSize&, const std::string& place) {
    throw InputError(place, "hemilux was built without libwebp");
}

#endif

} // namespace hemilux
