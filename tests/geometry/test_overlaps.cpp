// What flat polygons have in common, and which of many rectangles overlap.
#include "geometry/flat_polygon.h"
#include "geometry/rectangle_pairs.h"
#include "radiosity/sampling/rng.h"
#include "support/catch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

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

TEST_CASE("All pairs of rectangles that overlap are met, once each") {
    for (const double largest : {.02, .3, 1.0}) { // of the smaller ones; some are as wide as all
        Rng rng(7);
        std::vector<Rectangle> rectangles;
        for (std::uint32_t i = 0; i < 700; ++i) {
            const double size = i % 100 == 0 ? 1 : largest;
            const Vec2 low(rng.uniform(), rng.uniform());
            rectangles.push_back({low, low + size * Vec2(rng.uniform(), rng.uniform()), i, i % 2});
        }
        std::set<std::pair<std::uint32_t, std::uint32_t>> expected, met;
        for (const Rectangle& a : rectangles)
            for (const Rectangle& b : rectangles)
                if (a.index < b.index && a.low.x < b.high.x && b.low.x < a.high.x &&
                    a.low.y < b.high.y && b.low.y < a.high.y)
                    expected.emplace(a.index, b.index);
        for_each_overlap(rectangles, [&](std::uint32_t a, std::uint32_t b) {
            CHECK(met.emplace(std::min(a, b), std::max(a, b)).second);
            return true;
        });
        CHECK(met == expected);
        int calls = 0;
        for_each_overlap(rectangles, [&](std::uint32_t, std::uint32_t) { return ++calls < 3; });
        CHECK(calls == 3);
    }
}

TEST_CASE("A crowd that cannot be halved is compared unless it is of one set") {
    for (const bool one_set : {false, true}) {
        std::vector<Rectangle> rectangles;
        for (std::uint32_t i = 0; i < 200; ++i)
            rectangles.push_back({Vec2(-1.0 - i), Vec2(1.0 + i), i, one_set ? 0 : i});
        int met = 0;
        for_each_overlap(rectangles, [&](std::uint32_t, std::uint32_t) { return ++met > 0; });
        CHECK(met == (one_set ? 0 : 200 * 199 / 2));
    }
}
