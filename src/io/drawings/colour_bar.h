#pragma once
// One colour per number from 0 up, and the bar that says which.

#include "io/drawings/canvas.h"

#include <string>
#include <vector>

namespace hemilux {

/// Returns the colour of a number from 0 (pale) to 1 (dark), with lightness falling all the way.
/// Numbers beyond take the colours of the ends, NaN is grey.
[[nodiscard]] Colour heat_colour(double t);

/// A number on a bar; place 0 is its left end, 1 its right one.
struct BarMark {
    double place;
    std::string text;
};

/// Returns marks at 0 and at the multiples of 1, 2 or 5 times a power of ten up to `most`, the
/// number at the right end.
[[nodiscard]] std::vector<BarMark> round_marks(double most);

/// Draws the bar with round numbers and the caption below it, in 40 pixels. `low` and `high` are
/// its corners, top left and bottom right; 0 is at its left end, `most` at the right one.
void draw_colour_bar(const Vec2& low, const Vec2& high, double most, const std::string& caption,
                     Canvas& canvas);

} // namespace hemilux
