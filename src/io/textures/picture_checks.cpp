#include "io/textures/picture_checks.h"

#include "io/files/error.h"

#include <algorithm>

namespace hemilux {
namespace {

unsigned byte_at(std::string_view bytes, std::size_t at) {
    return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0;
}

void check_chunks(std::string_view bytes, const std::string& place) {
    constexpr std::size_t head = 8, checksum = 4;
    for (std::size_t at = png_signature.size(); at + head <= bytes.size();) {
        std::size_t length = 0;
        for (std::size_t k = 0; k < 4; ++k)
            length = length << 8 | byte_at(bytes, at + k);
        if (length > bytes.size() - at - head)
            throw InputError(place, "expected a whole PNG or JPEG picture: a chunk of it claims to "
                                    "be longer than the file");
        if (bytes.substr(at + 4, 4) == "IEND")
            return;
        at += head + length + checksum;
    }
}

/// Checks the tables that begin at `at`, behind a length of `left` bytes (ITU T.81, B.2.4.2), and
/// returns their end.
std::size_t check_tables(std::string_view bytes, std::size_t at, std::ptrdiff_t left,
                         const std::string& place) {
    constexpr std::size_t lengths = 16;
    while (left > 0 && at < bytes.size()) {
        std::size_t codes = 0;
        for (std::size_t k = 1; k <= lengths; ++k)
            codes += byte_at(bytes, at + k);
        if (codes > 256)
            throw InputError(place, "expected a whole PNG or JPEG picture: a Huffman table has "
                                    "more than 256 codes");
        at += 1 + lengths + codes;
        left -= static_cast<std::ptrdiff_t>(1 + lengths + codes);
    }
    return at;
}

/// More scans than these are refused; ten are usual. stb_image walks through all blocks of the size
/// claimed for each.
constexpr unsigned max_scans = 100;

/// Goes from marker to marker as stb_image does: what stands between them is data.
void check_segments(std::string_view bytes, const std::string& place) {
    constexpr unsigned define_huffman_table = 0xc4, first_restart = 0xd0, start = 0xd8, scan = 0xda;
    unsigned scans = 0;
    for (std::size_t at = jpeg_signature.size(); at < bytes.size();) {
        at = std::min(bytes.find('\xff', at), bytes.size());
        while (byte_at(bytes, at) == 0xff)
            ++at;
        const unsigned marker = byte_at(bytes, at++);
        if (marker <= 1 || (marker >= first_restart && marker <= start))
            continue; // has no length
        if (marker == scan && ++scans > max_scans)
            throw InputError(place, "expected a whole PNG or JPEG picture: it has more than " +
                                        std::to_string(max_scans) + " scans");
        const std::size_t length = byte_at(bytes, at) << 8 | byte_at(bytes, at + 1);
        if (marker == define_huffman_table)
            at = check_tables(bytes, at + 2, static_cast<std::ptrdiff_t>(length) - 2, place);
        else
            at += std::max<std::size_t>(length, 2);
    }
}

} // namespace

void check_picture(std::string_view bytes, const std::string& place) {
    if (bytes.starts_with(png_signature))
        check_chunks(bytes, place);
    else if (bytes.starts_with(jpeg_signature))
        check_segments(bytes, place);
}

} // namespace hemilux
