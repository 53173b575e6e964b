#include "io/textures/texture_files.h"

#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/files/text_words.h"
#include "io/textures/picture_checks.h"
#include "io/textures/webp.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <system_error>

namespace {

/// No picture of the size that its header states takes more bytes while it is unpacked: a small
/// file may hold gigabytes of zeros.
thread_local std::size_t max_bytes_unpacked = 0;

void* bounded_realloc(void* bytes, std::size_t size) {
    return size <= max_bytes_unpacked ? std::realloc(bytes, size) : nullptr;
}

} // namespace

#define STBI_MALLOC(size) std::malloc(size)
#define STBI_REALLOC(bytes, size) bounded_realloc(bytes, size)
#define STBI_FREE(bytes) std::free(bytes)
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#include <stb_image.h>

namespace hemilux {
namespace {

/// The most texels of a picture: a small file may claim any number.
constexpr double max_texels = 1 << 26;
/// The largest file [bytes]: more than the samples of so many texels take.
constexpr std::uint64_t max_file = std::uint64_t{1} << 30;
/// The memory per texel while a picture is decoded: the file's samples, and four bytes each twice.
constexpr double bytes_per_texel = 16;
/// The bytes per texel of a buffer, for the largest samples.
constexpr double bytes_unpacked_per_texel = 32;

struct Size {
    int width = 0, height = 0;
    [[nodiscard]] double texels() const { return double(width) * height; }
};

const stbi_uc* data_of(std::string_view bytes) {
    return reinterpret_cast<const stbi_uc*>(bytes.data());
}

Size size_of(std::string_view bytes, const std::string& place) {
    check_picture(bytes, place);
    Size size;
    int channels = 0;
    if (is_readable_webp(bytes)) {
        const WebpSize stated = webp_size(bytes, place);
        size = {stated.width, stated.height};
    } else if (bytes.size() > std::numeric_limits<int>::max() ||
               stbi_info_from_memory(data_of(bytes), static_cast<int>(bytes.size()), &size.width,
                                     &size.height, &channels) == 0)
        throw InputError(place,
                         "expected a PNG, JPEG or TGA picture of at most 16384 x 16384 pixels, "
                         "its header is broken");
    if (size.width < 1 || size.height < 1 || size.texels() > max_texels)
        throw InputError(place, "expected a picture of at most 67108864 pixels, found " +
                                    std::to_string(size.width) + " x " +
                                    std::to_string(size.height));
    return size;
}

/// Returns whether the bytes begin like a PNG, a JPEG or, if these are read, a WebP file.
bool is_picture_file(std::string_view bytes) {
    return bytes.starts_with(png_signature) || bytes.starts_with("\xff\xd8\xff") ||
           is_readable_webp(bytes);
}

/// Returns whether the bytes begin with a header of a picture, as far as stb_image knows it.
bool has_header(std::string_view bytes) {
    Size size;
    int channels = 0;
    return bytes.size() <= std::numeric_limits<int>::max() &&
           stbi_info_from_memory(data_of(bytes), static_cast<int>(bytes.size()), &size.width,
                                 &size.height, &channels) != 0;
}

} // namespace

Texture decode_texture(std::string_view bytes, const std::string& place) {
    Size size = size_of(bytes, place);
    const auto width = static_cast<std::uint32_t>(size.width),
               height = static_cast<std::uint32_t>(size.height);
    if (is_readable_webp(bytes))
        return {width, height, decode_webp(bytes, {size.width, size.height}, place),
                srgb_to_linear()};
    int channels = 0;
    // A picture takes eight bytes a texel at the most, and one a row; buffers grow by doubling.
    max_bytes_unpacked =
        static_cast<std::size_t>(bytes_unpacked_per_texel * size.texels()) + (std::size_t{1} << 16);
    const std::unique_ptr<stbi_uc, decltype(&std::free)> pixels(
        stbi_load_from_memory(data_of(bytes), static_cast<int>(bytes.size()), &size.width,
                              &size.height, &channels, STBI_rgb_alpha),
        &std::free);
    if (!pixels) {
        const std::string reason = stbi_failure_reason();
        throw InputError(
            place,
            "expected a whole PNG, JPEG or TGA picture: " +
                (reason == "outofmem" ? "its data unpack to more than its pixels take" : reason));
    }
    std::vector<std::uint8_t> rgb, cover;
    const std::size_t count = std::size_t{width} * height;
    rgb.reserve(3 * count);
    cover.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        const stbi_uc* const texel = &pixels.get()[STBI_rgb_alpha * k];
        rgb.insert(rgb.end(), texel, texel + 3);
        cover.push_back(texel[3]);
    }
    Texture texture(width, height, std::move(rgb), srgb_to_linear());
    if (std::ranges::any_of(cover, [](std::uint8_t byte) { return byte < 255; }))
        texture.set_cover(std::move(cover));
    return texture;
}

std::shared_ptr<const Texture> TextureFiles::decode(std::string_view bytes, const std::string& key,
                                                    bool is_tga) {
    if (!is_picture_file(bytes) && !(is_tga && has_header(bytes)))
        return known_[key] = nullptr;
    if (guard_)
        guard_(bytes_ + static_cast<double>(bytes.size()) +
               bytes_per_texel * size_of(bytes, key).texels());
    const auto texture = std::make_shared<const Texture>(decode_texture(bytes, key));
    bytes_ += texture->bytes();
    return known_[key] = texture;
}

std::optional<std::string> zlib_decompressed(std::string_view packed, std::size_t size) {
    constexpr std::size_t most = std::numeric_limits<int>::max();
    if (packed.size() > most || size > most)
        return std::nullopt;
    std::string bytes(size, '\0');
    const int found = stbi_zlib_decode_buffer(bytes.data(), static_cast<int>(size), packed.data(),
                                              static_cast<int>(packed.size()));
    return found >= 0 && static_cast<std::size_t>(found) == size ? std::optional(bytes)
                                                                 : std::nullopt;
}

std::shared_ptr<const Texture> TextureFiles::read(const std::string& path) {
    if (const auto texture = known(path))
        return *texture;
    if (!is_input(path, InputKind::regular))
        return known_[path] = nullptr;
    const bool is_tga = small_letters(path).ends_with(".tga");
    constexpr std::size_t signature = 12; // of the longest kind
    if (!is_tga && !is_picture_file(read_input(path, InputKind::regular, {}, signature)))
        return known_[path] = nullptr;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (!error && size > max_file)
        throw InputError(path, "expected a picture in a file of at most 1 GiB");
    if (guard_)
        guard_(bytes_ + static_cast<double>(size));
    return decode(read_input(path, InputKind::regular, {}, max_file), path, is_tga);
}

} // namespace hemilux
