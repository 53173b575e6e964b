#pragma once
// A picture is linear light in memory.

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace hemilux {

/// A picture's width and height in pixels.
struct PixelSize {
    int width, height;
};

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

} // namespace hemilux
