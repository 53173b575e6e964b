// What flat polygons have in common.
#include "geometry/flat_polygon.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace hemilux;

namespace {

/// Corners on a circle: convex.
FlatPolygon random_polygon(Rng& rng, std::size_t corners) {
    std::vector<double> angle;
    for (std::size_t i = 0; i < corners; ++i)
        angle.push_back(2 * std::numbers::pi * rng.uniform());
    std::ranges::sort(angle);
    const Vec2 centre(rng.uniform(), rng.uniform());
    const double radius = .2 + rng.uniform();
    FlatPolygon polygon;
    for (const double a : angle)
        polygon.add(centre + radius * Vec2(std::cos(a), std::sin(a)));
    return polygon;
}

bool contains(const FlatPolygon& polygon, const Vec2& point) {
    for (std::size_t i = 0; i < polygon.size; ++i) {
        const Vec2 a = polygon.corner[i], b = polygon.corner[(i + 1) % polygon.size];
        if ((b.x - a.x) * (point.y - a.y) < (b.y - a.y) * (point.x - a.x))
            return false;
    }
    return true;
}

} // namespace

TEST_CASE("The common part of two polygons has the area that both contain") {
    Rng rng(1);
    int met = 0;
    for (std::size_t trial = 0; trial < 200; ++trial) {
        const FlatPolygon a = random_polygon(rng, 3 + trial % 2);
        const FlatPolygon b = random_polygon(rng, 3 + trial / 2 % 2);
        constexpr int n = 60; // points of a grid over [-1.2,2.2]^2, which holds both
        constexpr double cell = 3.4 / n;
        int inside = 0;
        for (int k = 0; k < n * n; ++k) {
            const Vec2 p = Vec2(-1.2) + cell * Vec2(k % n + .5, k / n + .5);
            inside += contains(a, p) && contains(b, p);
        }
        const double area = common_part(a, b).area();
        CHECK(area == Approx(inside * cell * cell).margin(.05));
        CHECK(common_part(b, a).area() == Approx(area).margin(1e-12));
        CHECK(are_apart(a, b, 0) == !(area > 1e-12));
        met += area > 1e-12;
    }
    CHECK((met > 50 && met < 190));
}

TEST_CASE("Neighbours that share an edge are apart, however they are turned") {
    for (double angle = 0; angle < 6; angle += .1) {
        const Vec2 x(std::cos(angle), std::sin(angle)), y(-x.y, x.x), o(.1, .7);
        const FlatPolygon left{{o, o + x, o + x + 3.0 * y, o + 3.0 * y}, 4};
        const FlatPolygon right{{o + x, o + 2.0 * x, o + 2.0 * x + y, o + x + y}, 4};
        CHECK(are_apart(left, right, 1e-14));
        CHECK(std::abs(common_part(left, right).area()) < 1e-14);
        const FlatPolygon over{{o + .99 * x, o + 2.0 * x, o + 2.0 * x + y, o + .99 * x + y}, 4};
        CHECK_FALSE(are_apart(left, over, 1e-14));
        CHECK(common_part(left, over).area() == Approx(.01));
    }
}
