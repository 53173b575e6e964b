#include "support/closed_forms.h"

#include <cmath>
#include <numbers>

namespace hemilux::test {

using std::numbers::pi;

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

} // namespace hemilux::test
