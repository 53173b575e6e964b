// Spherical triangles: areas against other formulas, and directions against exact areas of parts.

#include "geometry/polar_warp.h"
#include "geometry/spherical_triangle.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/statistics.h"

#include <numbers>

using namespace hemilux;
using namespace hemilux::test;
using std::numbers::pi;

namespace {

const Vec3 pole(0, 0, 1), x_axis(1, 0, 0), y_axis(0, 1, 0);

Vec3 at(double azimuth, double elevation) {
    return {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
            std::sin(elevation)};
}

PolarWarp warp_of(const SphericalTriangle& t) {
    const auto& [a, b, c] = t.vertices();
    return {a, b, c};
}

/// Shapes for which the polar coordinates of the warp are special.
std::vector<SphericalTriangle> special_triangles() {
    return {
        {pole, x_axis, y_axis},                         // vertex at the pole, edge on the horizon
        {at(0, .3), at(2, .5), at(4, .7)},              // pole inside
        {at(0, .3), at(2, .5), at(pi, .4)},             // pole on an edge
        {at(0, .3), at(2, 0), at(4.2, 0)},              // pole inside, edge on the horizon
        {at(1, .2), at(1.6, .1), at(1, .9)},            // meridian edge first
        {at(1, .9), at(.4, .2), at(1, .2)},             // meridian edge last
        {at(1, 0), at(2, 0), at(1.5, .4)},              // on the horizon, apex up
        {at(1, 0), at(1.3, 0.001), at(1.2, .01)},       // low
        {at(1, .5), at(2, .4), at(1.5, 1.0)},           // two inner edges
        {at(0, 1e-9), at(2, 1e-12), at(4, 0)},          // nearly the whole hemisphere
        {at(0, .3), at(2, .5), at(pi + 1e-9, .4)},      // pole just inside
        {at(0, .3), at(2, .5), at(pi - 1e-9, .4)},      // pole just outside
        {at(0, pi / 2 - 1e-12), at(1, .2), at(2, .3)},  // pole almost a vertex
        {at(0, .5), at(1e-3, .5), at(5e-4, .5 + 1e-3)}, // small
        {at(0, .5), at(1.5, .5001), at(.7, .66)},       // long and thin
    };
}

} // namespace

TEST_CASE("areas of known triangles") {
    const SphericalTriangle octant(pole, x_axis, y_axis);
    CHECK(octant.solid_angle() == Approx(pi / 2).margin(1e-15));
    CHECK(octant.projected_solid_angle() == Approx(pi / 4).margin(1e-15));
    const auto parts = divided(octant, 1);
    CHECK(parts[3].solid_angle() == Approx(.5513).margin(5e-5));
    for (int i = 0; i < 3; ++i)
        CHECK(parts[static_cast<std::size_t>(i)].solid_angle() == Approx(.3398).margin(5e-5));
    // Lambert's formula for the triangles of the published table, over pi.
    const SphericalTriangle low(pole, glm::normalize(Vec3(1, 0, 1)), glm::normalize(Vec3(0, 1, 1)));
    CHECK(low.projected_solid_angle() / pi == Approx(.09622504).margin(5e-9));
    const SphericalTriangle around(glm::normalize(Vec3(1, 0, 1)), glm::normalize(Vec3(0, 1, 1)),
                                   glm::normalize(Vec3(-1, -1, 1)));
    CHECK(around.projected_solid_angle() / pi == Approx(.30034919).margin(5e-9));
}

TEST_CASE("areas agree with the angles at the corners and with division") {
    Rng rng(1);
    for (int i = 0; i < 300; ++i) {
        const SphericalTriangle t = random_triangle(rng, i % 3 == 0 ? 2.0 : .3);
        const auto& v = t.vertices();
        double excess = -pi; // Girard's theorem
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 to_next = glm::cross(v[k], v[(k + 1) % 3]);
            const Vec3 to_last = glm::cross(v[k], v[(k + 2) % 3]);
            excess +=
                std::atan2(glm::length(glm::cross(to_next, to_last)), glm::dot(to_next, to_last));
        }
        REQUIRE(t.solid_angle() == Approx(excess).margin(1e-12));
        double solid = 0, projected = 0;
        for (const SphericalTriangle& part : divided(t, 2)) {
            solid += part.solid_angle();
            projected += part.projected_solid_angle();
        }
        REQUIRE(t.solid_angle() == Approx(solid).margin(1e-13));
        REQUIRE(t.projected_solid_angle() == Approx(projected).margin(1e-13));
    }
}

TEST_CASE("areas of small triangles keep their digits") {
    for (const double size : {1e-3, 1e-5, 1e-7}) {
        const Vec3 a = at(.7, .4);
        const Vec3 b = glm::normalize(a + size * Vec3(-std::sin(.7), std::cos(.7), 0));
        const Vec3 c = glm::normalize(a + size * Vec3(0, 0, 1));
        const SphericalTriangle t(a, b, c);
        const double flat = 0.5 * glm::length(glm::cross(b - a, c - a));
        CHECK(t.solid_angle() / flat == Approx(1).margin(2 * size));
        CHECK(t.projected_solid_angle() / flat == Approx(a.z).margin(2 * size + 1e-8));
    }
}

TEST_CASE("edges and vertices belong to the triangle, points beyond do not") {
    Rng rng(2);
    for (int i = 0; i < 300; ++i) {
        const SphericalTriangle t = random_triangle(rng);
        const auto& v = t.vertices();
        const Vec3 centre = glm::normalize(v[0] + v[1] + v[2]);
        REQUIRE(contains(t, centre));
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 edge = glm::normalize(glm::mix(v[k], v[(k + 1) % 3], rng.uniform()));
            REQUIRE(contains(t, v[k]));
            REQUIRE(contains(t, edge));
            REQUIRE_FALSE(contains(t, glm::normalize(edge + 1e-6 * (edge - centre))));
        }
    }
}

TEST_CASE("the corners of the unit square give directions inside") {
    for (const SphericalTriangle& t : special_triangles()) {
        const PolarWarp warp = warp_of(t);
        for (const double x : {0.0, 0x1p-53, .5, 1 - 0x1p-53, 1.0})
            for (const double y : {0.0, 0x1p-53, .5, 1 - 0x1p-53, 1.0}) {
                const Vec3 d = warp.sample({x, y});
                const auto& v = t.vertices();
                CAPTURE(v[0].x, v[0].y, v[0].z, x, y, d.x, d.y, d.z);
                REQUIRE(std::abs(glm::length(d) - 1) < 1e-14);
                for (std::size_t k = 0; k < 3; ++k) {
                    const Vec3 m = glm::normalize(glm::cross(v[k], v[(k + 1) % 3]));
                    REQUIRE(glm::dot(m, d) > -1e-11);
                }
            }
    }
}

TEST_CASE("the warp is continuous") {
    Rng rng(5);
    auto triangles = special_triangles();
    for (int i = 0; i < 50; ++i)
        triangles.push_back(random_triangle(rng));
    constexpr int n = 400;
    for (const SphericalTriangle& t : triangles) {
        const double y = rng.uniform();
        const PolarWarp warp = warp_of(t);
        // Near a corner the steps grow as the root of 1/n. The first and the last step may swing
        // across a pole that lies on an edge.
        for (int i = 1; i + 1 < n; ++i) {
            const Vec3 a = warp.sample({double(i) / n, y}), b = warp.sample({(i + 1.0) / n, y});
            CAPTURE(t.vertices()[0].x, t.vertices()[0].y, t.vertices()[0].z, i, y);
            REQUIRE(glm::length(Vec2(a) - Vec2(b)) < 4 / std::sqrt(double(n)));
        }
    }
}

TEST_CASE("triangles without area give finite directions and end") {
    Rng rng(6);
    const Vec3 a = at(1, .5), b = at(1.4, .2);
    const Vec3 middle = glm::normalize(a + b);
    for (const SphericalTriangle& t :
         {SphericalTriangle(a, a, a), SphericalTriangle(a, b, b), SphericalTriangle(a, middle, b),
          SphericalTriangle(pole, pole, a), SphericalTriangle(a, b, pole)}) {
        for (int i = 0; i < 20; ++i) {
            const Vec3 d = t.sample_rejection([&] { return rng.uniform(); });
            REQUIRE(std::abs(glm::length(d) - 1) < 1e-12);
        }
    }
}

TEST_CASE("directions follow the cosine density: special and general triangles") {
    Rng rng(7);
    auto triangles = special_triangles();
    for (int i = 0; i < 25; ++i)
        triangles.push_back(random_triangle(rng));
    const double alpha = sidak(significance, 2 * triangles.size());
    const auto uniform = [&] { return rng.uniform(); };
    for (const SphericalTriangle& t : triangles) {
        const Histogram histogram(t);
        const PolarWarp warp = warp_of(t);
        CHECK(warp.area() == Approx(t.projected_solid_angle()).epsilon(1e-9));
        CHECK(chi_square(20000, histogram.expected, [&] {
                  return histogram.cell(warp.sample(random_pair(rng)));
              }).p_value > alpha);
        CHECK(chi_square(20000, histogram.expected, [&] {
                  return histogram.cell(t.sample_rejection(uniform));
              }).p_value > alpha);
    }
}

TEST_CASE("a wrong density fails the test that the right one passes") {
    Rng rng(8);
    const SphericalTriangle octant(pole, x_axis, y_axis);
    const Histogram histogram(octant);
    const auto draw_uniform_in_solid_angle = [&] {
        for (;;) {
            const Vec3 d = random_upper_direction(rng);
            if (contains(octant, d))
                return histogram.cell(d);
        }
    };
    CHECK(chi_square(5000, histogram.expected, draw_uniform_in_solid_angle).p_value < 1e-12);
}
