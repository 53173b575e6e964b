#pragma once
// Differences of pictures in false colour: blue where a picture is too dark, red where it is too
// bright, white where it is right.

#include "io/drawings/canvas.h"
#include "io/pictures/picture_files.h"
#include "radiosity/answers/images/image.h"

#include <span>
#include <vector>

namespace hemilux {

/// Returns the colour of a number from -1 (dark blue) over 0 (white) to 1 (dark red). Numbers
/// beyond take the colours of the ends, NaN is grey. Lightness falls evenly to both sides.
[[nodiscard]] Colour diverging_colour(double t);

/// Returns the luminance of a picture minus that of the reference, in units of the exposure's
/// white. Throws std::invalid_argument unless both have one size.
[[nodiscard]] std::vector<float> luminance_difference(const Image& picture, const Image& reference,
                                                      double exposure);

/// One scale for all pictures that are compared. It is even about 0, where pictures that are nearly
/// right differ, and logarithmic beyond, for those that are far off.
struct DifferenceScale {
    double typical = 1; ///< limit of the even part, about
    double most = 1;    ///< the darkest colours; at least `typical`

    /// Returns the place of a difference on the scale, from -1 to 1.
    [[nodiscard]] double place(double difference) const;
};

/// Chooses a scale: 99 of 100 values are within `typical` in half of the differences, and within
/// `most` in all. Both are 1, 2 or 5 times a power of ten.
[[nodiscard]] DifferenceScale common_scale(std::span<const std::vector<float>> differences);

/// Draws the difference with a colour bar below it, for write_png with exposure 1.
[[nodiscard]] Image false_colour(const std::vector<float>& difference, int width, int height,
                                 const DifferenceScale& scale);

} // namespace hemilux
