#pragma once
// The bar below a picture in false colour that says which colour is which number.

#include "io/drawings/colour_bar.h"
#include "io/pictures/picture_files.h"
#include "radiosity/answers/images/image.h"

#include <functional>
#include <span>
#include <string>

namespace hemilux {

/// Returns the colour as linear light, so that write_png with exposure 1 shows that colour.
[[nodiscard]] glm::vec3 linear(Colour colour);

/// Returns the picture with a white strip below it: the colours of the places from 0 to 1, the
/// marks and the caption.
[[nodiscard]] Image with_bar(const Image& picture, const std::function<Colour(double)>& colour,
                             std::span<const BarMark> marks, std::string caption);

} // namespace hemilux
