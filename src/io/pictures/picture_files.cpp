#include "io/pictures/picture_files.h"

#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/files/provenance.h"
#include "io/pictures/picture_provenance.h"
#include "radiosity/answers/images/tone.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <string_view>

namespace {

/// The flag of compress_little_on().
std::atomic<const std::atomic<bool>*> hurry{nullptr};

} // namespace

bool hemilux::is_in_a_hurry() {
    const std::atomic<bool>* const flag = hurry;
    return flag && *flag;
}

#ifdef HEMILUX_ZLIB
#include <zlib.h>

namespace {

/// Compresses by zlib, which is faster than stb_image_write; the caller frees the bytes. A null
/// pointer says that there is no memory. It looks for runs only with a quality of 1, and once there
/// is a hurry.
unsigned char* compressed_by_zlib(unsigned char* bytes, int length, int* packed_length,
                                  int quality) {
    constexpr int most = 6; // beyond, it takes long for little
    constexpr std::size_t at_once = 1 << 20, slack = 64;
    z_stream stream{};
    if (deflateInit(&stream, std::min(quality, most)) != Z_OK)
        return nullptr;
    const std::size_t size = deflateBound(&stream, static_cast<uLong>(length)) + slack;
    auto* const packed = static_cast<unsigned char*>(std::malloc(size));
    stream.next_out = packed;
    stream.avail_out = packed ? static_cast<uInt>(size) : 0;
    bool hurries = false;
    const auto whole = static_cast<std::size_t>(length);
    for (std::size_t begin = 0; packed && begin < whole; begin += at_once) {
        if (!hurries && (quality == 1 || hemilux::is_in_a_hurry()))
            hurries = deflateParams(&stream, Z_BEST_SPEED, Z_RLE) == Z_OK;
        stream.next_in = bytes + begin;
        stream.avail_in = static_cast<uInt>(std::min(at_once, whole - begin));
        deflate(&stream, Z_NO_FLUSH);
    }
    const bool is_whole = packed && deflate(&stream, Z_FINISH) == Z_STREAM_END;
    *packed_length = static_cast<int>(stream.total_out);
    deflateEnd(&stream);
    if (is_whole)
        return packed;
    std::free(packed);
    return nullptr;
}

} // namespace

#define STBIW_ZLIB_COMPRESS compressed_by_zlib
#endif
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

namespace hemilux {
namespace {

/// Appends to a std::string what stb_image_write hands over piece by piece.
void append(void* bytes, void* data, int size) {
    static_cast<std::string*>(bytes)->append(static_cast<const char*>(data),
                                             static_cast<std::size_t>(size));
}

/// Appends a chunk of a PNG file (PNG specification, 3rd edition, section 5.3).
void add_chunk(std::string& file, std::string_view name, std::string_view content) {
    const auto add_number = [&](std::uint32_t number) {
        for (int shift = 24; shift >= 0; shift -= 8)
            file += static_cast<char>(number >> shift & 255u);
    };
    add_number(static_cast<std::uint32_t>(content.size()));
    std::string bytes(name);
    bytes += content;
    add_number(stbiw__crc32(reinterpret_cast<unsigned char*>(bytes.data()),
                            static_cast<int>(bytes.size())));
    file.insert(file.size() - 4, bytes);
}

/// Returns a PNG file whose rows are all differences from the one above: choosing among filters
/// takes longer than all else.
std::string quick_png(int width, int height, std::span<const std::uint8_t> pixels,
                      int bytes_per_pixel) {
    constexpr unsigned char up = 2;
    const auto row = static_cast<std::size_t>(bytes_per_pixel) * static_cast<std::size_t>(width);
    std::vector<unsigned char> bytes((row + 1) * static_cast<std::size_t>(height));
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
        unsigned char* const to = &bytes[y * (row + 1)];
        const std::uint8_t* const from = &pixels[y * row];
        to[0] = up;
        for (std::size_t k = 0; k < row; ++k)
            to[k + 1] = static_cast<unsigned char>(from[k] - (y > 0 ? from[k - row] : 0));
    }
    std::string header;
    for (const int size : {width, height})
        for (int shift = 24; shift >= 0; shift -= 8)
            header += static_cast<char>(size >> shift & 255);
    constexpr char bits = 8, colours = 2, colours_and_alpha = 6;
    header += {bits, bytes_per_pixel == 4 ? colours_and_alpha : colours, 0, 0, 0};
    std::string file = "\x89PNG\r\n\x1a\n";
    add_chunk(file, "IHDR", header);
    add_chunk(file, "IDAT", zlib_compressed(std::move(bytes), Compression::little));
    add_chunk(file, "IEND", {});
    return file;
}

/// RGBE has no sign, no infinity and no NaN.
float clean(float x) { return x > 0 ? std::min(x, std::numeric_limits<float>::max() / 2) : 0.0f; }

} // namespace

std::string zlib_compressed(std::vector<unsigned char> bytes, Compression compression) {
    const int quality = compression == Compression::little ? 1 : 5;
    int length = 0;
    const std::unique_ptr<unsigned char, decltype(&std::free)> packed(
        stbi_zlib_compress(bytes.data(), static_cast<int>(bytes.size()), &length, quality),
        &std::free);
    if (!packed)
        throw std::bad_alloc();
    return {packed.get(), packed.get() + length};
}

void compress_little_on(const std::atomic<bool>* flag) { hurry = flag; }

std::string png_of(int width, int height, const std::vector<std::uint8_t>& bytes,
                   int bytes_per_pixel, Compression compression) {
    if (compression == Compression::little || is_in_a_hurry())
        return quick_png(width, height, bytes, bytes_per_pixel);
    std::string file;
    if (!stbi_write_png_to_func(append, &file, width, height, bytes_per_pixel, bytes.data(),
                                bytes_per_pixel * width))
        throw std::bad_alloc();
    return file;
}

void write_png(const std::string& path, const Image& image, const Display& display,
               const Provenance& from, Compression compression) {
    std::vector<std::uint8_t> bytes(3 * image.pixels.size());
    for (std::size_t k = 0; k < image.pixels.size(); ++k) {
        std::uint8_t* const byte = &bytes[3 * k];
        if (k > 0 && image.pixels[k] == image.pixels[k - 1]) { // as within squares
            std::copy_n(byte - 3, 3, byte);
            continue;
        }
        const glm::vec3 shown = display(image.pixels[k]);
        for (int channel = 0; channel < 3; ++channel)
            byte[channel] = srgb_byte(shown[channel]);
    }
    std::string file = png_of(image.width, image.height, bytes, 3, compression);
    add_to_png(file, from);
    write_atomically(path, file);
}

void write_hdr(const std::string& path, const Image& image, const Provenance& from) {
    std::vector<float> values;
    values.reserve(3 * image.pixels.size());
    for (const glm::vec3& pixel : image.pixels)
        for (int channel = 0; channel < 3; ++channel)
            values.push_back(clean(pixel[channel]));
    std::string file;
    if (!stbi_write_hdr_to_func(append, &file, image.width, image.height, 3, values.data()))
        throw OutputError(path, "cannot encode the picture");
    add_to_hdr(file, from);
    write_atomically(path, file);
}

} // namespace hemilux
