#pragma once
// Maps the unit square to directions of the hemisphere with density cos(theta) / pi.
//
// The concentric map of square and disc (Shirley and Chiu 1997) keeps the distances between points
// better than polar coordinates; its points are lifted to the hemisphere. The engine compiles this
// once per instruction set. So all functions are static, and none is shared by files that are
// compiled in different ways.

#include <cmath>

namespace hemilux {

// These functions give sine and cosine of pi/4 t for |t| <= 1 by Taylor's series, whose first term
// left out is below half of the last bit. They are written out, as the library's own differ from
// machine to machine.

[[maybe_unused]] static inline double sine_of_eighths(double x2, double x) {
    double sum = 1.0 / 355687428096000; // 17!
    sum = sum * x2 - 1.0 / 1307674368000;
    sum = sum * x2 + 1.0 / 6227020800;
    sum = sum * x2 - 1.0 / 39916800;
    sum = sum * x2 + 1.0 / 362880;
    sum = sum * x2 - 1.0 / 5040;
    sum = sum * x2 + 1.0 / 120;
    sum = sum * x2 - 1.0 / 6;
    return sum * x2 * x + x;
}

[[maybe_unused]] static inline double cosine_of_eighths(double x2) {
    double sum = 1.0 / 20922789888000; // 16!
    sum = sum * x2 - 1.0 / 87178291200;
    sum = sum * x2 + 1.0 / 479001600;
    sum = sum * x2 - 1.0 / 3628800;
    sum = sum * x2 + 1.0 / 40320;
    sum = sum * x2 - 1.0 / 720;
    sum = sum * x2 + 1.0 / 24;
    sum = sum * x2 - 0.5;
    return sum * x2 + 1.0;
}

/// Sets (x, y, z) to the direction, of unit length with z >= 0, for u and v in [0,1].
[[maybe_unused]] static inline void concentric_direction(double u, double v, double& x, double& y,
                                                         double& z) {
    constexpr double eighth = 0x1.921fb54442d18p-1; // of a turn: pi / 4
    const double a = 2 * u - 1, b = 2 * v - 1;
    const bool wide = std::fabs(a) > std::fabs(b);
    const double r = wide ? a : b, other = wide ? b : a;
    const double angle = eighth * (other / (r == 0 ? 1.0 : r));
    const double s = r * sine_of_eighths(angle * angle, angle);
    const double c = r * cosine_of_eighths(angle * angle);
    x = wide ? c : s;
    y = wide ? s : c;
    const double z2 = 1 - r * r;
    z = std::sqrt(z2 > 0 ? z2 : 0.0);
}

} // namespace hemilux
