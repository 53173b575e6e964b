// Form factors by contour integration, against closed forms and against plain quadrature.
#include "radiosity/engine/factors/pairs/exchange_area.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/directions.h"

using namespace hemilux;
using test::opposed_rectangles;
using test::perpendicular_rectangles;
using test::point_to_polygon;

namespace {

Polygon quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return {{a, b, c, d}}; }

double factor(const Polygon& from, const Polygon& to) {
    return exchange_area(from, to) / from.area();
}

/// Midpoint rule over the first polygon of the factor from a point.
double by_quadrature(const Polygon& from, const Polygon& to, int n) {
    const Vec3 normal = from.normal(), other = to.normal();
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec3 point = from.sample({(i + .5) / n, (j + .5) / n});
            if (glm::dot(point - to.corner[0], other) > 0) // seen by the front of `to`
                sum += point_to_polygon(point, normal, to);
        }
    return sum / (n * n);
}

} // namespace

TEST_CASE("Opposed rectangles have the factor of the closed form") {
    for (const double a : {.01, .5, 1.0, 3.0, 40.0})
        for (const double b : {.02, 1.0, 7.0}) {
            const Polygon low = quad({0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0});
            const Polygon high = quad({0, 0, 1}, {0, b, 1}, {a, b, 1}, {a, 0, 1});
            CAPTURE(a, b);
            CHECK(factor(low, high) ==
                  Approx(opposed_rectangles(a, b)).epsilon(1e-9).margin(1e-10));
            CHECK(factor(low, high.flipped()) == 0);
            CHECK(factor(low.flipped(), high) == 0);
        }
}

TEST_CASE("Perpendicular rectangles with a common edge have the factor of the closed form") {
    for (const double h : {.05, .5, 1.0, 4.0})
        for (const double w : {.1, 1.0, 6.0}) {
            const Polygon floor = quad({0, 0, 0}, {w, 0, 0}, {w, 1, 0}, {0, 1, 0});
            const Polygon wall = quad({0, 0, 0}, {0, 1, 0}, {0, 1, h}, {0, 0, h});
            CAPTURE(h, w);
            CHECK(factor(floor, wall) == Approx(perpendicular_rectangles(h, w)).epsilon(1e-9));
            CHECK(exchange_area(floor, wall) == Approx(exchange_area(wall, floor)).epsilon(1e-9));
        }
}

TEST_CASE("A factor is the sum of those to the parts, also where edges only partly coincide") {
    const Polygon floor = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    const Polygon below = quad({0, 0, 0}, {0, .3, 0}, {0, .3, 1}, {0, 0, 1});
    const Polygon above = quad({0, .3, 0}, {0, 1, 0}, {0, 1, 1}, {0, .3, 1});
    CHECK(factor(floor, below) + factor(floor, above) ==
          Approx(perpendicular_rectangles(1, 1)).epsilon(1e-9));
}

TEST_CASE("Polygons that cut each other's planes are clipped") {
    Rng rng(17);
    int seen = 0;
    for (int i = 0; i < 40; ++i) {
        const auto triangle = [&] {
            const Vec3 a = test::random_point(rng), b = test::random_point(rng),
                       c = test::random_point(rng);
            return Polygon{{a, b, c, c}};
        };
        const Polygon from = triangle();
        Polygon to = triangle();
        for (Vec3& corner : to.corner)
            corner += Vec3(3, 0, 0); // apart, so that the quadrature is good
        const double f = factor(from, to);
        CHECK(f == Approx(by_quadrature(from, to, 150)).epsilon(2e-3).margin(1e-6));
        seen += f > 0;
    }
    CHECK(seen > 5);
}
