// Form factors against the published digits, against each other and against numeric integration;
// and the directions of shadow rays against the cosine density.

#include "geometry/frame.h"
#include "geometry/projected_polygon.h"
#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/directions.h"
#include "support/statistics.h"

#include <cmath>
#include <numbers>

using namespace hemilux;
using namespace hemilux::test;
using std::numbers::pi;

namespace {

constexpr double printed = 5.001e-9; // half a unit of the eighth decimal
const Vec3 origin(0.0), up(0, 0, 1);

Polygon triangle(const Vec3& a, const Vec3& b, const Vec3& c) { return {{a, b, c, c}}; }

/// A planar convex quad or a triangle somewhere near the origin.
Polygon random_polygon(Rng& rng) {
    const Vec3 centre = 2.0 * random_point(rng);
    const Frame frame = Frame::from_normal(random_direction(rng));
    Polygon result;
    const bool three = rng.uniform() < .5;
    for (std::size_t i = 0; i < 4; ++i) {
        const double angle = (static_cast<double>(i) + .8 * rng.uniform()) * pi / 2;
        result.corner[i] = centre + std::cos(angle) * frame.x + std::sin(angle) * frame.y;
    }
    if (three)
        result.corner[3] = result.corner[2];
    return result;
}

/// Midpoint rule over the area of the kernel max(0, cos) |cos'| / (pi r^2).
double integrated_factor(const Vec3& point, const Vec3& normal, const Polygon& p, int n) {
    double sum = 0;
    const Vec3 p_normal = p.normal();
    const auto add_triangle = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        const double area = .5 * glm::length(glm::cross(b - a, c - a)) / (n * n);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j <= 2 * i; ++j) { // the small triangles of strip i
                const double u = (i + (j % 2 ? 1.0 / 3 : 2.0 / 3)) / n;
                const double v = (j / 2 + (j % 2 ? 2.0 / 3 : 1.0 / 3)) / n;
                const Vec3 d = a + u * (b - a) + v * (c - b) - point;
                const double r_squared = glm::dot(d, d);
                sum += area * std::max(0.0, glm::dot(d, normal)) * std::abs(glm::dot(d, p_normal)) /
                       (pi * r_squared * r_squared);
            }
    };
    add_triangle(p.corner[0], p.corner[1], p.corner[2]);
    if (!p.is_triangle())
        add_triangle(p.corner[0], p.corner[2], p.corner[3]);
    return sum;
}

double distance(const Vec3& point, const Polygon& p) { // a lower bound
    double nearest = glm::length(p.centre() - point);
    for (const Vec3& corner : p.corner)
        nearest = std::min(nearest, glm::length(corner - point));
    return std::min(nearest, std::abs(glm::dot(p.normal(), p.corner[0] - point)));
}

bool hits(const Polygon& p, const Vec3& point, const Vec3& direction) {
    const Vec3 n = p.area_vector();
    const double t = glm::dot(n, p.corner[0] - point) / glm::dot(n, direction);
    if (!(t > 0))
        return false;
    const Vec3 at = point + t * direction;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 edge = p.corner[(i + 1) % 4] - p.corner[i];
        if (glm::dot(n, glm::cross(edge, at - p.corner[i])) < -1e-9)
            return false;
    }
    return true;
}

} // namespace

TEST_CASE("published values") {
    CHECK(opposed_rectangles(1, 1) == Approx(.19982490).margin(printed));
    CHECK(opposed_rectangles(2, 1) == Approx(.28587538).margin(printed));
    CHECK(opposed_rectangles(5, 5) == Approx(.69024469).margin(printed));
    CHECK(perpendicular_rectangles(1, 1) == Approx(.20004378).margin(printed));
    CHECK(perpendicular_rectangles(2, 1) == Approx(.23285260).margin(printed));
    CHECK(perpendicular_rectangles(1, 2) == Approx(.11642630).margin(printed));
    CHECK(perpendicular_rectangles(.5, .5) == Approx(.24063601).margin(printed));
    CHECK(coaxial_disks(1, 1) == Approx(.38196601).margin(printed));
    CHECK(coaxial_disks(.5, 1) == Approx(.46887113).margin(printed));
    CHECK(coaxial_disks(2, 2) == Approx(.60961180).margin(printed));
    CHECK(point_under_corner(1, 1) == Approx(.13853161).margin(printed));
    CHECK(point_under_corner(.5, .5) == Approx(.05986412).margin(printed));
}

TEST_CASE("published values of point to polygon") {
    CHECK(point_to_polygon(origin, up, triangle({0, 0, 1}, {1, 0, 1}, {0, 1, 1})) ==
          Approx(.09622504).margin(printed));
    CHECK(point_to_polygon(origin, up, triangle({1, 0, 1}, {0, 1, 1}, {-1, -1, 1})) ==
          Approx(.30034919).margin(printed));
    const Polygon square{{Vec3(-.5, -.5, 1), {.5, -.5, 1}, {.5, .5, 1}, {-.5, .5, 1}}};
    CHECK(point_to_polygon(origin, up, square) == Approx(.23945647).margin(printed));
    CHECK(point_to_polygon(origin, up, square.flipped()) == Approx(.23945647).margin(printed));
}

TEST_CASE("a closed box has factors with the sum 1") {
    for (const double a : {.3, 1.0, 4.0})
        for (const double b : {.5, 2.0}) {
            // Floor a x b, height 1: its wall of length a has H = 1/a and the floor W = b/a.
            const double walls = 2 * perpendicular_rectangles(1 / a, b / a) +
                                 2 * perpendicular_rectangles(1 / b, a / b);
            CHECK(opposed_rectangles(a, b) + walls == Approx(1).margin(1e-12));
        }
    for (const double r : {.2, 1.0, 3.0}) // reciprocity
        CHECK(r * r * coaxial_disks(r, 1) == Approx(coaxial_disks(1, r)).margin(1e-14));
}

TEST_CASE("point to polygon agrees with the corner formula and adds up to 1 in a box") {
    Rng rng(21);
    for (int i = 0; i < 200; ++i) {
        const double a = 3 * rng.uniform(), b = 3 * rng.uniform(), c = .1 + rng.uniform();
        const Polygon p{{Vec3(0, 0, c), {0, b, c}, {a, b, c}, {a, 0, c}}};
        REQUIRE(point_to_polygon(origin, up, p) ==
                Approx(point_under_corner(a / c, b / c)).margin(1e-14));
    }
    // From inside a unit cube, in any direction, everything seen is wall.
    const Vec3 lll(0), hll(1, 0, 0), lhl(0, 1, 0), hhl(1, 1, 0), llh(0, 0, 1), hlh(1, 0, 1),
        lhh(0, 1, 1), hhh(1);
    const std::array<Polygon, 6> faces{{{{lll, hll, hhl, lhl}},
                                        {{llh, hlh, hhh, lhh}},
                                        {{lll, hll, hlh, llh}},
                                        {{lhl, hhl, hhh, lhh}},
                                        {{lll, lhl, lhh, llh}},
                                        {{hll, hhl, hhh, hlh}}}};
    for (int i = 0; i < 200; ++i) {
        const Vec3 point = .5 + .499 * random_point(rng), normal = random_direction(rng);
        double sum = 0;
        for (const Polygon& face : faces)
            sum += point_to_polygon(point, normal, face);
        REQUIRE(sum == Approx(1).margin(1e-12));
    }
}

TEST_CASE("point to polygon against numeric integration, horizon included") {
    Rng rng(22);
    int clipped = 0, done = 0;
    while (done < 60) {
        const Polygon p = random_polygon(rng);
        const Vec3 point = random_point(rng), normal = random_direction(rng);
        if (distance(point, p) < .3)
            continue;
        int above = 0;
        for (const Vec3& corner : p.corner)
            above += glm::dot(normal, corner - point) > 0;
        clipped += above > 0 && above < 4;
        ++done;
        REQUIRE(point_to_polygon(point, normal, p) ==
                Approx(integrated_factor(point, normal, p, 100)).margin(2e-4));
    }
    CHECK(clipped > 10);
}

TEST_CASE("edge-on, below the horizon, coplanar and touching polygons") {
    const Polygon wall{{Vec3(0, 0, 0), {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}};
    const Polygon below{{Vec3(0, 0, -1), {0, 1, -1}, {1, 1, -1}, {1, 0, -1}}};
    CHECK(point_to_polygon(origin, up, below) == 0);
    CHECK(point_to_polygon({0, .5, .5}, up, wall) == 0); // in its interior
    CHECK(point_to_polygon({0, .5, 0}, up, wall) == 0);  // on an edge
    CHECK(point_to_polygon({0, 0, 0}, up, wall) == 0);   // on a corner
    CHECK(point_to_polygon({0, 3, .2}, up, wall) == 0);  // in its plane
    // In the plane of the receiver.
    const Polygon floor{{Vec3(1, 0, 0), {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}};
    CHECK(point_to_polygon(origin, up, floor) == 0);
    // Close to a wall it fills half of the view; the limit is not the value on the edge.
    const Polygon wide{{Vec3(0, -1e3, 0), {0, 1e3, 0}, {0, 1e3, 1e3}, {0, -1e3, 1e3}}};
    for (const double x : {1e-2, 1e-8, 1e-11})
        CHECK(point_to_polygon({x, 0, 0}, up, wide) == Approx(.5).margin(1e-3 + x));
    // A polygon through the receiver's plane counts as much as its upper half.
    const Polygon upper{{Vec3(1, 0, 0), {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}};
    const Polygon both{{Vec3(1, 0, -2), {1, 1, -2}, {1, 1, 1}, {1, 0, 1}}};
    CHECK(point_to_polygon(origin, up, both) ==
          Approx(point_to_polygon(origin, up, upper)).epsilon(1e-13));
    // Without area.
    CHECK(point_to_polygon(origin, up, triangle({1, 0, 1}, {2, 0, 1}, {3, 0, 1})) == 0);
    CHECK(point_to_polygon(origin, up, triangle({1, 0, 1}, {1, 0, 1}, {1, 0, 1})) == 0);
}

TEST_CASE("small distant polygons keep their digits") {
    for (const double size : {1e-2, 1e-4, 1e-6}) {
        const Vec3 at(2, 1, 3);
        const Polygon p = triangle(at, at + Vec3(size, 0, 0), at + Vec3(0, size, 0));
        const double r_squared = glm::dot(at, at);
        const double flat = size * size / 2 * 9 / (pi * r_squared * r_squared);
        CHECK(point_to_polygon(origin, up, p) / flat == Approx(1).margin(size + 1e-8));
    }
}

TEST_CASE("directions towards a polygon: factor, aim and horizon") {
    Rng rng(23);
    int seen = 0;
    for (int i = 0; i < 2000; ++i) {
        const Polygon p = random_polygon(rng);
        const Vec3 point = random_point(rng);
        const Frame frame = Frame::from_normal(random_direction(rng));
        const ProjectedPolygon projected(point, frame, p);
        if (!(projected.factor() > 0))
            continue;
        ++seen;
        for (int k = 0; k < 10; ++k) {
            const Vec3 d = projected.sample(random_pair(rng));
            REQUIRE(std::abs(glm::length(d) - 1) < 1e-13);
            REQUIRE(glm::dot(d, frame.z) > -1e-14);
            REQUIRE(hits(p, point, d));
        }
    }
    CHECK(seen > 1000);
}

TEST_CASE("rounding at the horizon does not move directions towards a polygon") {
    const Frame frame = Frame::from_normal({0, 0, 1});
    const auto standing = [&](double foot) {
        return ProjectedPolygon(
            Vec3(0.0), frame,
            {{Vec3(1, -.3, foot), Vec3(1, .4, -foot), Vec3(1, .4, .8), Vec3(1, -.3, .8)}});
    };
    const ProjectedPolygon exact = standing(0);
    for (const double foot : {1e-16, -1e-16, 1e-9, -1e-9}) {
        const ProjectedPolygon rounded = standing(foot);
        CAPTURE(foot);
        CHECK(rounded.factor() == Approx(exact.factor()).epsilon(1e-12));
        for (const double u : {.01, .3, .7, .99})
            CHECK(glm::distance(rounded.sample({u, .6}), exact.sample({u, .6})) < 1e-7);
    }
}

TEST_CASE("directions towards a polygon follow Lambert's law") {
    // Cells: 3 x 3 pieces of the polygon, unequally cut; the expected share of each is its own
    // factor.
    constexpr std::array<double, 4> cuts{0, .23, .61, 1};
    Rng rng(24);
    constexpr int polygons = 40;
    const double alpha = sidak(significance, polygons);
    int done = 0, clipped = 0;
    while (done < polygons) {
        const Vec3 corner = random_point(rng), a = random_direction(rng), b = random_direction(rng);
        const Vec3 point = random_point(rng);
        const Frame frame = Frame::from_normal(random_direction(rng));
        const auto piece = [&](double s0, double s1, double t0, double t1) {
            return Polygon{{corner + s0 * a + t0 * b, corner + s1 * a + t0 * b,
                            corner + s1 * a + t1 * b, corner + s0 * a + t1 * b}};
        };
        const Polygon whole = piece(0, 1, 0, 1);
        const ProjectedPolygon projected(point, frame, whole);
        if (projected.factor() < .01 || glm::length(glm::cross(a, b)) < .3)
            continue;
        ++done;
        std::vector<double> expected;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                expected.push_back(
                    point_to_polygon(point, frame.z,
                                     piece(cuts[i], cuts[i + 1], cuts[k], cuts[k + 1])) /
                    projected.factor());
        for (const Vec3& c : whole.corner)
            if (glm::dot(frame.z, c - point) < 0) {
                ++clipped;
                break;
            }
        const auto draw = [&] {
            const Vec3 d = projected.sample(random_pair(rng));
            const Vec3 n = glm::cross(a, b);
            const Vec3 at = point + d * (glm::dot(n, corner - point) / glm::dot(n, d)) - corner;
            const double s = glm::dot(glm::cross(at, b), n) / glm::dot(n, n);
            const double t = glm::dot(glm::cross(a, at), n) / glm::dot(n, n);
            const auto cell = [&](double x) { return x < cuts[1] ? 0u : x < cuts[2] ? 1u : 2u; };
            return std::size_t{3} * cell(s) + cell(t);
        };
        CHECK(chi_square(5000, expected, draw).p_value > alpha);
    }
    CHECK(clipped > 5);
}
