// Triangles and planar quads as one type: area, normal, centre of mass and uniform points.

#include "geometry/polygon.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/statistics.h"

#include <cmath>
#include <vector>

using namespace hemilux;
using namespace hemilux::test;

namespace {

const Polygon triangle{{Vec3(0, 0, 2), {3, 0, 2}, {0, 2, 2}, {0, 2, 2}}};
const Polygon rectangle{{Vec3(0, 0, 0), {2, 0, 0}, {2, 0, 3}, {0, 0, 3}}};
const Polygon trapezoid{{Vec3(0, 0, 1), {4, 0, 1}, {3, 1, 1}, {1, 1, 1}}};
const Polygon kite{{Vec3(0, 0, 0), {1, -1, 0}, {5, 0, 0}, {1, 1, 0}}};
const Polygon lopsided{{Vec3(0, 0, 0), {5, .2, 0}, {4, 2, 0}, {.1, .3, 0}}};

/// Area of a triangle or quad in a z-plane to the left of x = c, by clipping.
double area_left_of(const Polygon& p, double c) {
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec2 a(p.corner[i]), b(p.corner[(i + 1) % 4]);
        if (a.x <= c)
            kept.push_back(a);
        if ((a.x < c) != (b.x < c))
            kept.push_back(a + (b - a) * ((c - a.x) / (b.x - a.x)));
    }
    double twice = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const Vec2 &a = kept[i], &b = kept[(i + 1) % kept.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return std::abs(twice) / 2;
}

} // namespace

TEST_CASE("area, normal and size") {
    CHECK(triangle.size() == 3);
    CHECK(rectangle.size() == 4);
    CHECK(triangle.area() == Approx(3));
    CHECK(rectangle.area() == Approx(6));
    CHECK(trapezoid.area() == Approx(3));
    CHECK(kite.area() == Approx(5));
    CHECK(triangle.normal() == Vec3(0, 0, 1));
    CHECK(rectangle.normal() == Vec3(0, -1, 0));
    CHECK(trapezoid.normal() == Vec3(0, 0, 1));
    for (const Polygon& p : {triangle, rectangle, trapezoid, kite}) {
        CHECK(p.flipped().normal() == -p.normal());
        CHECK(p.flipped().area() == Approx(p.area()));
        CHECK(p.flipped().size() == p.size());
        CHECK(p.flipped().flipped().corner == p.corner);
    }
}

TEST_CASE("the centre is the mean of uniform points") {
    CHECK(glm::length(rectangle.centre() - Vec3(1, 0, 1.5)) < 1e-14);
    CHECK(glm::length(trapezoid.centre() - Vec3(2, 4.0 / 9, 1)) < 1e-14);
    CHECK(glm::length(kite.centre() - Vec3(2, 0, 0)) < 1e-14);
    Rng rng(31);
    const double alpha = sidak(significance, 5 * 3);
    for (const Polygon& p : {triangle, rectangle, trapezoid, kite, lopsided}) {
        std::array<MeanTest, 3> mean;
        for (int i = 0; i < 20000; ++i) {
            const Vec3 at = p.sample(random_pair(rng));
            for (int k = 0; k < 3; ++k)
                mean[static_cast<std::size_t>(k)].add(at[k]);
        }
        for (int k = 0; k < 3; ++k) {
            const MeanTest& m = mean[static_cast<std::size_t>(k)];
            const bool constant = m.standard_error() < 1e-12;
            CHECK((constant || m.p_value(p.centre()[k]) > alpha));
        }
    }
}

TEST_CASE("points are uniform over the area") {
    constexpr std::size_t strips = 13;
    const std::vector<Polygon> polygons{triangle, trapezoid, kite, lopsided};
    const double alpha = sidak(significance, 2 * polygons.size());
    Rng rng(32);
    for (Polygon p : polygons)
        for (int turn = 0; turn < 2; ++turn) { // strips across x, then across y
            double low = p.corner[0].x, high = low;
            for (const Vec3& c : p.corner) {
                low = std::min(low, c.x);
                high = std::max(high, c.x);
            }
            std::vector<double> expected;
            for (std::size_t i = 0; i < strips; ++i) {
                const auto edge = [&](std::size_t k) {
                    return low + (high - low) * static_cast<double>(k) / strips;
                };
                expected.push_back((area_left_of(p, edge(i + 1)) - area_left_of(p, edge(i))) /
                                   p.area());
            }
            const auto draw = [&] {
                const double x = p.sample(random_pair(rng)).x;
                const double share = (x - low) / (high - low);
                return std::min(strips - 1, static_cast<std::size_t>(share * strips));
            };
            CHECK(chi_square(20000, expected, draw).p_value > alpha);
            for (Vec3& c : p.corner)
                c = {-c.y, c.x, c.z};
        }
}

TEST_CASE("points lie inside, also for the corners of the unit square") {
    Rng rng(33);
    for (const Polygon& p : {triangle, rectangle, trapezoid, kite, lopsided})
        for (int i = 0; i < 1000; ++i) {
            Vec2 u = random_pair(rng);
            if (i < 9)
                u = {(i % 3) / 2.0, (i / 3) / 2.0};
            const Vec3 at = p.sample(u);
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec3 edge = p.corner[(k + 1) % 4] - p.corner[k];
                REQUIRE(glm::dot(p.normal(), glm::cross(edge, at - p.corner[k])) > -1e-12);
            }
        }
}

TEST_CASE("a polygon without area gives points, not NaN") {
    const Polygon line{{Vec3(0, 0, 0), {1, 0, 0}, {3, 0, 0}, {2, 0, 0}}};
    const Vec3 at = line.sample({.3, .7});
    CHECK(std::isfinite(at.x));
    CHECK(std::isfinite(line.centre().x));
    CHECK(line.area() == 0);
}

TEST_CASE("quarters fill a polygon, and those of a triangle are alike") {
    for (const Polygon& whole : {triangle, rectangle, trapezoid, kite, lopsided}) {
        Vec3 sum(0.0), moment(0.0);
        for (const Polygon& quarter : quarters_of(whole)) {
            CHECK(quarter.size() == whole.size());
            CHECK(glm::length(quarter.normal() - whole.normal()) < 1e-12);
            sum += quarter.area_vector();
            moment += quarter.area() * quarter.centre();
            if (whole.is_triangle())
                CHECK(quarter.area() == Approx(whole.area() / 4));
        }
        CHECK(glm::length(sum - whole.area_vector()) < 1e-12);
        CHECK(glm::length(moment / whole.area() - whole.centre()) < 1e-12);
    }
}

TEST_CASE("parts are quarters of quarters, those of one quarter side by side") {
    for (const Polygon& whole : {triangle, kite}) {
        CHECK(part_of(whole, 1, 0).corner == whole.corner);
        for (const std::size_t parts : {4u, 16u, 64u}) {
            const std::size_t below = parts / 4;
            for (std::size_t quarter = 0; quarter < 4; ++quarter) {
                Vec3 sum(0.0);
                for (std::size_t k = 0; k < below; ++k)
                    sum += part_of(whole, parts, quarter * below + k).area_vector();
                CHECK(glm::length(sum - quarters_of(whole)[quarter].area_vector()) < 1e-12);
            }
        }
    }
}
