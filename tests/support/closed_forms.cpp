#include "support/closed_forms.h"

#include "geometry/projected_polygon.h"

#include <cmath>
#include <numbers>

namespace hemilux::test {

using std::numbers::pi;

double opposed_rectangles(double x, double y) {
    const double p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
    // (1+X^2)(1+Y^2)/(1+X^2+Y^2) = 1 + X^2 Y^2/(1+X^2+Y^2): log1p keeps far rectangles accurate.
    const double logarithm = 0.5 * std::log1p(x * x * y * y / (1 + x * x + y * y));
    const double arcs =
        x * q * std::atan(x / q) + y * p * std::atan(y / p) - x * std::atan(x) - y * std::atan(y);
    return 2 / (pi * x * y) * (logarithm + arcs);
}

double perpendicular_rectangles(double h, double w) {
    const double hh = h * h, ww = w * w, sum = hh + ww;
    const double root = std::sqrt(sum);
    const double arcs = w * std::atan(1 / w) + h * std::atan(1 / h) - root * std::atan(1 / root);
    const double logarithms = std::log((1 + ww) * (1 + hh) / (1 + sum)) +
                              ww * std::log(ww * (1 + sum) / ((1 + ww) * sum)) +
                              hh * std::log(hh * (1 + sum) / ((1 + hh) * sum));
    return (arcs + 0.25 * logarithms) / (pi * w);
}

double coaxial_disks(double r1, double r2) {
    const double s = 1 + (1 + r2 * r2) / (r1 * r1);
    const double product = (r2 / r1) * (r2 / r1); // of the two roots; theirs is the smaller
    return 2 * product / (s + std::sqrt(s * s - 4 * product));
}

double point_under_corner(double a, double b) {
    const double p = std::sqrt(1 + a * a), q = std::sqrt(1 + b * b);
    return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2 * pi);
}

double point_to_polygon(const Vec3& point, const Vec3& normal, const Polygon& polygon) {
    return ProjectedPolygon(point, Frame::from_normal(normal), polygon).factor();
}

} // namespace hemilux::test
