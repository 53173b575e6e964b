#pragma once
// Pictures are linear light in memory. They are written as PNG for the eye (sRGB, 8 bits) and as
// Radiance HDR for numbers.

#include "io/files/provenance.h"
#include "io/pictures/tone.h"

#include <glm/glm.hpp>

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace hemilux {

struct Image {
    int width = 0, height = 0;     ///< [pixels]
    std::vector<glm::vec3> pixels; ///< linear, row by row from the top left

    Image() = default;
    /// Makes a black picture.
    Image(int width_, int height_)
        : width(width_), height(height_),
          pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
    [[nodiscard]] glm::vec3& at(int x, int y) { return pixels[index(x, y)]; }
    [[nodiscard]] const glm::vec3& at(int x, int y) const { return pixels[index(x, y)]; }
};

/// Returns the luminance of linear light in the primaries of sRGB (IEC 61966-2-1).
[[nodiscard]] inline float luminance(const glm::vec3& colour) {
    return glm::dot(colour, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// Applies the transfer curve of sRGB (IEC 61966-2-1), from linear [0,1] to encoded [0,1]; clamps.
[[nodiscard]] float srgb_from_linear(float linear);
/// Returns 255 times that, rounded.
[[nodiscard]] std::uint8_t srgb_byte(float linear);
/// Applies the inverse of srgb_from_linear().
[[nodiscard]] float linear_from_srgb(float encoded);

/// Returns the factor that brings the bright part of what surfaces reflect to 0.8. With Y the
/// luminances of the pixels without what is emitted there, as far as they are not 0, it is
///
///   0.8 / min(percentile_95(Y), 12 percentile_50(Y)):
///
/// so emitters and skies in view have no part in it, a twentieth of the picture may be brighter,
/// and the darker half is not lost beside a patch of sun. Pixels that emit more than they reflect
/// count where they are 99 % of those, and nowhere else. It is 1 for a black picture. Where nothing
/// is reflected all light counts. `emission` has the size of the picture, or is empty where nothing
/// is emitted.
[[nodiscard]] double auto_exposure(const Image& image, const Image& emission = {});

/// Sets the flag of a hurry: once it is true, pictures are compressed little, as a large one takes
/// many seconds otherwise. With nullptr, as at the start, there is never one.
void compress_little_on(const std::atomic<bool>* flag);
[[nodiscard]] bool is_in_a_hurry();

/// This says how much time a file may take to be small.
enum class Compression { usual, little };

/// Returns the bytes of a PNG file of three bytes a pixel, or four with alpha, row by row from the
/// top left. Throws std::bad_alloc.
[[nodiscard]] std::string png_of(int width, int height, const std::vector<std::uint8_t>& bytes,
                                 int bytes_per_pixel = 3,
                                 Compression compression = Compression::usual);

/// Writes 8 bits per channel through the sRGB curve, as `display` shows the light. Where the
/// provenance is known, the file has tEXt chunks Software, Command and Seed. Throws OutputError.
void write_png(const std::string& path, const Image& image, const Display& display,
               const Provenance& from = {}, Compression compression = Compression::usual);
/// Writes Radiance RGBE, which is linear, with the provenance as lines of the header. Throws
/// OutputError.
void write_hdr(const std::string& path, const Image& image, const Provenance& from = {});

/// Returns the bytes as a zlib stream (RFC 1950), as a PNG and an EXR file have them. Throws
/// std::bad_alloc.
[[nodiscard]] std::string zlib_compressed(std::vector<unsigned char> bytes,
                                          Compression compression = Compression::usual);

} // namespace hemilux
