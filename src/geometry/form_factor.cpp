#include "geometry/form_factor.h"

#include "geometry/frame.h"
#include "geometry/horizon_clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hemilux {

using std::numbers::pi;

double opposed_rectangles(double x, double y) {
    const double p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
    // (1+X^2)(1+Y^2)/(1+X^2+Y^2) = 1 + X^2 Y^2/(1+X^2+Y^2): log1p keeps far rectangles accurate.
    const double logarithm = 0.5 * std::log1p(x * x * y * y / (1 + x * x + y * y));
    const double arcs =
        x * q * std::atan(x / q) + y * p * std::atan(y / p) - x * std::atan(x) - y * std::atan(y);
    return 2 / (pi * x * y) * (logarithm + arcs);
}

double point_to_polygon(const Vec3& point, const Vec3& normal, const Polygon& polygon) {
    const Frame frame = Frame::from_normal(normal);
    std::array<Vec3, 4> corners;
    for (std::size_t i = 0; i < 4; ++i)
        corners[i] = frame.to_local(polygon.corner[i] - point);
    return std::min(1.0, projected_solid_angle(clip_to_horizon(corners)) / pi);
}

} // namespace hemilux
