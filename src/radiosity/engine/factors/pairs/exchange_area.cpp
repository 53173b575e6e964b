#include "radiosity/engine/factors/pairs/exchange_area.h"

#include "geometry/box.h"
#include "geometry/elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hemilux {

namespace {

Plane plane_of(const Polygon& polygon) { return {polygon.corner[0], polygon.normal()}; }

/// Integrates ln |x - y| for y along an edge of unit direction e.
double log_integral(const Vec3& x, const Vec3& start, const Vec3& e, double length) {
    const Vec3 d = x - start;
    const double along = glm::dot(d, e), h = glm::length(glm::cross(d, e));
    const auto primitive = [h](double u) {
        const double square = u * u + h * h;
        if (!(square > 0))
            return 0.0;
        return 0.5 * u * elementary::log(square) - u + (h > 0 ? h * elementary::atan(u / h) : 0.0);
    };
    return primitive(length - along) - primitive(-along);
}

/// Integrates f over [a, b] by the rule of eight points (Abramowitz and Stegun 1964, table 25.4).
template <class Function>
double gauss(const Function& f, double a, double b) {
    static constexpr std::array<Vec2, 4> rule{{{0.1834346424956498, 0.3626837833783620},
                                               {0.5255324099163290, 0.3137066458778873},
                                               {0.7966664774136267, 0.2223810344533745},
                                               {0.9602898564975363, 0.1012285362903763}}};
    const double middle = (a + b) / 2, half = (b - a) / 2;
    double sum = 0;
    for (const Vec2& point : rule)
        sum += point.y * (f(middle - half * point.x) + f(middle + half * point.x));
    return half * sum;
}

/// The accuracy that an integral over [0,1] is asked for and can have: errors over parts of it add
/// up.
struct Accuracy {
    double tolerance, rounding;
};

/// Halves the interval until its halves give what the whole gave.
template <class Function>
double adaptive(const Function& f, double a, double b, double whole, const Accuracy& accuracy,
                int depth) {
    const double middle = (a + b) / 2;
    const double left = gauss(f, a, middle), right = gauss(f, middle, b);
    const double enough = (b - a) * std::max(accuracy.tolerance, accuracy.rounding);
    if (depth == 0 || !(std::abs(left + right - whole) > enough))
        return left + right;
    return adaptive(f, a, middle, left, accuracy, depth - 1) +
           adaptive(f, middle, b, right, accuracy, depth - 1);
}

double contour_integral(const Outline& from, const Outline& to, double tolerance) {
    constexpr int max_halvings = 40;
    double sum = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3 start = from[i], edge = from[(i + 1) % from.size()] - start;
        for (std::size_t j = 0; j < to.size(); ++j) {
            const Vec3 other = to[(j + 1) % to.size()] - to[j];
            const double length = glm::length(other), product = glm::dot(edge, other);
            if (!(std::abs(product) > 0))
                continue;
            const Vec3 e = other / length;
            const auto f = [&](double t) {
                return product / length * log_integral(start + t * edge, to[j], e, length);
            };
            constexpr double epsilon = 4e-16; // of the primitives, which are about 1
            const Accuracy accuracy{tolerance, epsilon * std::abs(product) / length};
            sum += adaptive(f, 0, 1, gauss(f, 0, 1), accuracy, max_halvings);
        }
    }
    return sum;
}

} // namespace

Outline outline_of(const Polygon& polygon) {
    return {polygon.corner.begin(), polygon.corner.begin() + polygon.size()};
}

Outline in_front(const Outline& outline, const Plane& plane, double rounding) {
    Outline part;
    const double highest =
        clip_in_front(outline, plane, [&](const Vec3& corner) { part.push_back(corner); });
    return highest > rounding && part.size() >= 3 ? part : Outline{};
}

FacingPair facing_parts(const Polygon& from, const Polygon& to, double rounding) {
    FacingPair pair{in_front(outline_of(from), plane_of(to), rounding),
                    in_front(outline_of(to), plane_of(from), rounding)};
    if (pair.from.empty() || pair.to.empty())
        return {};
    return pair;
}

double exchange_area(const Outline& from, const Outline& to, double smaller_area) {
    // The unit of length makes both outlines and their distance about 1. In ln r any unit will do,
    // as the edges of an outline sum to zero.
    Box box = box_of(from);
    box.include(box_of(to));
    const Vec3 origin = box.centre();
    const double unit = glm::length(box.extent()) / 2;
    const auto scaled = [&](Outline outline) {
        for (Vec3& p : outline)
            p = (p - origin) / unit;
        return outline;
    };
    constexpr double error = 1e-10, max_edge_pairs = 25;
    const double tolerance =
        error * 2 * std::numbers::pi * smaller_area / (unit * unit) / max_edge_pairs;
    return unit * unit / (2 * std::numbers::pi) *
           std::abs(contour_integral(scaled(from), scaled(to), tolerance));
}

double exchange_area(const Polygon& from, const Polygon& to) {
    const FacingPair pair = facing_parts(from, to, 0);
    return pair.from.empty() ? 0
                             : exchange_area(pair.from, pair.to, std::min(from.area(), to.area()));
}

} // namespace hemilux
