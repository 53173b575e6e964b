#pragma once
// How alike two pictures look: the structural similarity index (SSIM) of Wang, Bovik, Sheikh and
// Simoncelli 2004, "Image quality assessment: from error visibility to structural similarity",
// section III, with the constants of its section III.C.
//
// It is 1 for equal pictures and less the more that brightness, contrast and structure of the
// places of a picture differ. By the table that is widely used to read it in terms of what people
// say (Zinner, Hohlfeld, Abboud and Hossfeld 2010) a picture is excellent from 0.99 on, good from
// 0.95, fair from 0.88.

#include "radiosity/answers/images/image.h"
#include "radiosity/answers/images/tone.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// Luma from 0 to 255, row by row from the top.
struct LumaPicture {
    int width = 0, height = 0;
    std::vector<double> values;

    [[nodiscard]] double at(int x, int y) const {
        return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

/// Of bytes of R, G and B as they stand in a PNG: 0.299 R + 0.587 G + 0.114 B (ITU-R BT.601).
[[nodiscard]] LumaPicture luma_of(int width, int height, std::span<const std::uint8_t> rgb);

/// The same of a picture as it is written with this display.
[[nodiscard]] LumaPicture luma_of(const Image& image, const Display& display);

/// The index at each place whose window of 11 x 11 pixels lies within both pictures, row by row:
/// (width - 10) x (height - 10) values of the window around pixel (x + 5, y + 5). Throws
/// std::invalid_argument if the sizes differ or are below 11.
[[nodiscard]] std::vector<double> ssim_map(const LumaPicture& a, const LumaPicture& b);

/// Half of a window, which the map has less at each edge.
inline constexpr int ssim_margin = 5;

/// The mean of the map, MSSIM of the source.
[[nodiscard]] double ssim(const LumaPicture& a, const LumaPicture& b);

/// Returns the mean that the index is expected to have between a picture with noise and the same
/// picture without. `again` is the first with as much independent noise once more. So the variance
/// m of their difference in a window is that of the noise, v - m is that of the picture without,
/// and the index of structure becomes (2 (v - m) + C2) / (2 (v - m) + m + C2), with v the variance
/// of the first. The means of windows are compared as they are.
[[nodiscard]] double ssim_without_noise(const LumaPicture& noisy, const LumaPicture& again);

} // namespace hemilux
