#pragma once
// The bar below a picture in false colour that says which colour is which number.

#include "io/drawings/colour_bar.h"
#include "io/pictures/image.h"

#include <functional>
#include <span>
#include <string>

namespace hemilux {

/// Linear light, so that write_png with exposure 1 gives the colour.
[[nodiscard]] glm::vec3 linear(Colour colour);

/// The picture with a white strip below it: the colours of the places from 0 to 1, marks, caption.
[[nodiscard]] Image with_bar(const Image& picture, const std::function<Colour(double)>& colour,
                             std::span<const BarMark> marks, std::string caption);

} // namespace hemilux
