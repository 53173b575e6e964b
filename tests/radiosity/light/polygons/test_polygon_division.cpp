#include "radiosity/light/polygons/polygon_division.h"

#include "geometry/frame.h"
#include "geometry/polygon.h"
#include "radiosity/light/polygons/ear_clipping.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

using namespace hemilux;

namespace {

using Flat = std::vector<Vec2>;
using Corners = std::vector<Vec3>;

/// In the plane through `origin` with that normal.
Corners placed(const Flat& flat, const Vec3& normal = {0, 0, 1}, const Vec3& origin = Vec3(0.0)) {
    const Frame frame = Frame::from_normal(glm::normalize(normal));
    Corners corners;
    for (const Vec2& p : flat)
        corners.push_back(origin + p.x * frame.x + p.y * frame.y);
    return corners;
}

/// In extended precision: the reference must not be what is inexact.
double shoelace(const Corners& corners) {
    using Vector = glm::tvec3<long double>;
    Vector twice(0.0L);
    for (std::size_t i = 2; i < corners.size(); ++i)
        twice += glm::cross(Vector(corners[i - 1]) - Vector(corners[0]),
                            Vector(corners[i]) - Vector(corners[0]));
    return static_cast<double>(0.5L * glm::length(twice));
}

Polygon shape_of(const PolygonDivision::Piece& piece, const Corners& corners) {
    return {{corners[piece[0]], corners[piece[1]], corners[piece[2]], corners[piece[3]]}};
}

double total_area(const PolygonDivision& division, const Corners& corners) {
    long double sum = 0;
    for (const PolygonDivision::Piece& piece : division.pieces())
        sum += shape_of(piece, corners).area();
    return static_cast<double>(sum);
}

bool triangle_contains(const Vec3& a, const Vec3& b, const Vec3& c, const Vec2& p) {
    const auto side = [&](const Vec3& from, const Vec3& to) {
        return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x) > 0;
    };
    return side(a, b) && side(b, c) && side(c, a);
}

bool polygon_contains(const Flat& flat, const Vec2& p) {
    bool inside = false;
    for (std::size_t i = 0, j = flat.size() - 1; i < flat.size(); j = i++)
        if ((flat[i].y > p.y) != (flat[j].y > p.y) &&
            p.x < flat[i].x + (p.y - flat[i].y) / (flat[j].y - flat[i].y) * (flat[j].x - flat[i].x))
            inside = !inside;
    return inside;
}

/// Every piece faces the front, the areas sum to the polygon's, and random points lie in exactly
/// one piece inside the polygon and in none outside.
void check_covers(const Flat& flat) {
    PolygonDivision division;
    const Corners oblique = placed(flat, {0.3, -0.5, 0.7}, {1, 2, 3});
    const PolygonFlags flags = division.divide(oblique);
    CHECK_FALSE(flags.degenerate);
    CHECK_FALSE(flags.nonplanar);
    CHECK_FALSE(flags.crossing);
    CHECK(total_area(division, oblique) == Approx(shoelace(oblique)).epsilon(1e-12));

    const Corners corners = placed(flat);
    (void)division.divide(corners);
    CHECK(total_area(division, corners) == Approx(shoelace(corners)).epsilon(1e-12));
    for (const PolygonDivision::Piece& piece : division.pieces())
        CHECK(shape_of(piece, corners).area_vector().z > 0);

    Rng rng(1);
    for (int k = 0; k < 300; ++k) {
        const Vec2 p(2.4 * rng.uniform() - 1.2, 2.4 * rng.uniform() - 1.2);
        int covering = 0;
        for (const PolygonDivision::Piece& piece : division.pieces()) {
            const auto& c = shape_of(piece, corners).corner;
            covering += triangle_contains(c[0], c[1], c[2], p);
            covering += piece[2] != piece[3] && triangle_contains(c[0], c[2], c[3], p);
        }
        CHECK(covering == (polygon_contains(flat, p) ? 1 : 0));
    }
}

/// Corners that appear in no piece.
std::size_t unused_corners(const PolygonDivision& division, std::size_t n) {
    std::set<std::uint32_t> used;
    for (const PolygonDivision::Piece& piece : division.pieces())
        used.insert(piece.begin(), piece.end());
    return n - used.size();
}

Flat regular(std::size_t n, double radius = 1) {
    Flat flat;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * double(i) / double(n);
        flat.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return flat;
}

Flat random_star(std::size_t n, Rng& rng) {
    Flat flat = regular(n);
    for (Vec2& p : flat)
        p *= 0.1 + 0.9 * rng.uniform();
    return flat;
}

/// A bar below and `teeth` rectangular teeth above it.
Flat comb(std::size_t teeth) {
    Flat flat{{-1, -1}, {1, -1}};
    for (std::size_t i = teeth; i-- > 0;) {
        const double left = -1 + 2.0 * double(2 * i) / double(2 * teeth - 1);
        const double right = -1 + 2.0 * double(2 * i + 1) / double(2 * teeth - 1);
        flat.emplace_back(right, 1);
        flat.emplace_back(left, 1);
        if (i > 0) {
            flat.emplace_back(left, -0.9);
            flat.emplace_back(-1 + 2.0 * double(2 * i - 1) / double(2 * teeth - 1), -0.9);
        }
    }
    return flat;
}

/// A band wound up `turns` times.
Flat spiral(std::size_t n, double turns) {
    Flat outer, inner;
    for (std::size_t i = 0; i < n; ++i) {
        const double t = double(i) / double(n - 1);
        const double angle = 2 * std::numbers::pi * turns * t, radius = 0.1 + 0.8 * t;
        const Vec2 direction(std::cos(angle), std::sin(angle));
        outer.push_back((radius + 0.4 / turns) * direction);
        inner.push_back(radius * direction);
    }
    outer.insert(outer.end(), inner.rbegin(), inner.rend());
    return outer;
}

} // namespace

TEST_CASE("a planar convex quad and a triangle stay as they are", "[polygon_division]") {
    PolygonDivision division;
    const Corners square = placed({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {1, 1, 1});
    const PolygonFlags flags = division.divide(square);
    CHECK_FALSE((flags.degenerate || flags.nonplanar || flags.concave || flags.crossing));
    REQUIRE(division.pieces().size() == 1);
    CHECK(division.pieces()[0] == PolygonDivision::Piece{0, 1, 2, 3});

    CHECK_FALSE(division.divide(placed({{0, 0}, {1, 0}, {0, 1}})).degenerate);
    REQUIRE(division.pieces().size() == 1);
    CHECK(division.pieces()[0] == PolygonDivision::Piece{0, 1, 2, 2});
}

TEST_CASE("a concave quad is cut from its reflex corner", "[polygon_division]") {
    const Flat arrow{{0, 0}, {1, -1}, {0, 1}, {-1, -1}};
    for (std::size_t turn = 0; turn < 4; ++turn) {
        Flat flat = arrow;
        std::rotate(flat.begin(), flat.begin() + std::ptrdiff_t(turn), flat.end());
        const Corners corners = placed(flat);
        PolygonDivision division;
        const PolygonFlags flags = division.divide(corners);
        CHECK(flags.concave);
        CHECK_FALSE(flags.nonplanar);
        CHECK(division.pieces().size() == 2);
        CHECK(total_area(division, corners) == Approx(1).epsilon(1e-14));
        check_covers(flat);
    }
}

TEST_CASE("planarity of quads is judged relative to their size", "[polygon_division]") {
    PolygonDivision division;
    for (const double size : {1e-30, 1e-3, 1.0, 1e6, 1e90}) {
        Corners quad{{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, 0}};
        quad[2].z = 1e-7 * size;
        CHECK_FALSE(division.divide(quad).nonplanar);
        CHECK(division.pieces().size() == 1);
        quad[2].z = 1e-4 * size;
        const PolygonFlags flags = division.divide(quad);
        CHECK(flags.nonplanar);
        CHECK_FALSE(flags.concave);
        CHECK(division.pieces().size() == 2);
    }
}

TEST_CASE("corners equal to the one before are left out", "[polygon_division]") {
    PolygonDivision division;
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
    CHECK_FALSE(division.divide(Corners{a, a, b, c, c, d, a}).degenerate);
    REQUIRE(division.pieces().size() == 1);
    CHECK(division.pieces()[0] == PolygonDivision::Piece{0, 2, 3, 5});
    CHECK_FALSE(division.divide(Corners{a, b, b, c}).degenerate);
    REQUIRE(division.pieces().size() == 1);
    CHECK(division.pieces()[0] == PolygonDivision::Piece{0, 1, 3, 3});
}

TEST_CASE("polygons without area have no pieces", "[polygon_division]") {
    PolygonDivision division;
    const Vec3 a(0.1, 0.1, 0.1), b(0.2, 0.2, 0.2), c(0.3, 0.3, 0.3), d(0.7, 0.7, 0.7);
    const Corners cases[] = {{},        {a},       {a, b},       {a, a, a},      {a, b, a},
                             {a, b, c}, {a, a, b}, {a, b, c, d}, {a, b, d, c, b}};
    for (const Corners& corners : cases) {
        const PolygonFlags flags = division.divide(corners);
        CHECK(flags.degenerate);
        CHECK_FALSE(flags.crossing);
        CHECK(division.pieces().empty());
    }
    // A sliver far thinner than float but well above double's rounding is a face.
    CHECK_FALSE(division.divide(Corners{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-12, 0}}).degenerate);
}

TEST_CASE("convex polygons become strips of quads", "[polygon_division]") {
    for (const std::size_t n : {5u, 6u, 7u, 12u, 101u}) {
        PolygonDivision division;
        const Flat flat = regular(n);
        const PolygonFlags flags = division.divide(placed(flat));
        CHECK_FALSE(flags.concave);
        CHECK(division.pieces().size() == (n - 1) / 2);
        check_covers(flat);
    }
}

TEST_CASE("star-shaped polygons keep their area", "[polygon_division]") {
    Rng rng(7);
    for (int k = 0; k < 60; ++k)
        check_covers(random_star(5 + std::size_t(60 * rng.uniform()), rng));
    check_covers(random_star(1000, rng));
}

TEST_CASE("combs and spirals keep their area", "[polygon_division]") {
    for (const std::size_t teeth : {2u, 3u, 10u, 250u})
        check_covers(comb(teeth));
    check_covers(spiral(20, 1.5));
    check_covers(spiral(300, 5));
    check_covers(regular(1000));
    const Corners large = placed(comb(10000), {1, 2, 3}); // cubic time would never end
    PolygonDivision division;
    (void)division.divide(large);
    CHECK(total_area(division, large) == Approx(shoelace(large)).epsilon(1e-12));
}

TEST_CASE("straight corners become corners of pieces", "[polygon_division]") {
    const Flat triangle{{-1, -1}, {-0.5, -1}, {0, -1}, {0.7, -1}, {1, -1}, {0, 1}};
    const Flat square{{-1, -1}, {0.1, -1}, {1, -1}, {1, 0.1}, {1, 1}, {0.1, 1}, {-1, 1}, {-1, 0.1}};
    Flat grid; // on thirds, which doubles cannot represent
    for (int i = 0; i < 3; ++i)
        grid.emplace_back(i / 3.0, 0.1);
    for (int i = 0; i < 3; ++i)
        grid.emplace_back(1, 0.1 + i / 3.0);
    for (int i = 3; i > 0; --i)
        grid.emplace_back(i / 3.0, 1.1);
    for (int i = 3; i > 0; --i)
        grid.emplace_back(0, 0.1 + i / 3.0);
    for (const Flat& flat : {triangle, square, grid}) {
        PolygonDivision division;
        for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(1, -2, 0.4)}) {
            const PolygonFlags flags = division.divide(placed(flat, normal));
            CHECK_FALSE(flags.concave);
            CHECK_FALSE(flags.crossing);
            CHECK(unused_corners(division, flat.size()) == 0);
        }
        check_covers(flat);
    }
}

TEST_CASE("a hole with a bridge to it keeps its area", "[polygon_division]") {
    check_covers({{-1, -1},
                  {1, -1},
                  {1, 1},
                  {-1, 1},
                  {-1, -1},
                  {-0.5, -0.5},
                  {-0.5, 0.5},
                  {0.5, 0.5},
                  {0.5, -0.5},
                  {-0.5, -0.5}});
    Flat ring = regular(100);
    ring.push_back(ring.front());
    for (std::size_t i = 0; i <= 40; ++i)
        ring.push_back(regular(40, 0.6)[(40 - i) % 40]);
    check_covers(ring);
}

TEST_CASE("a spike without width is harmless", "[polygon_division]") {
    PolygonDivision division;
    for (const Vec2& tip : {Vec2(2, 0), Vec2(0.5, 0)}) { // outward and inward
        const Corners corners = placed({{-1, -1}, {1, -1}, {1, 0}, tip, {1, 0}, {1, 1}, {-1, 1}});
        CHECK_FALSE(division.divide(corners).degenerate);
        CHECK(total_area(division, corners) == Approx(4).epsilon(1e-12));
    }
}

TEST_CASE("polygons that cross themselves are reported and stay finite", "[polygon_division]") {
    Flat pentagram;
    for (std::size_t i = 0; i < 5; ++i)
        pentagram.push_back(regular(5)[2 * i % 5]);
    Rng rng(3);
    Flat scribble;
    for (int i = 0; i < 200; ++i)
        scribble.emplace_back(rng.uniform(), rng.uniform());
    const Flat bow_tie{{0, 0}, {1, 1}, {1, 0}, {0, 0.5}},
        even_bow_tie{{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    for (const Flat& flat : {pentagram, scribble, bow_tie, even_bow_tie}) {
        const Corners corners = placed(flat, {3, 1, -2});
        PolygonDivision division;
        CHECK(division.divide(corners).crossing);
        CHECK(std::isfinite(total_area(division, corners)));
        CHECK(division.pieces().size() < corners.size());
    }
}

TEST_CASE("non-planar polygons are divided within their outline", "[polygon_division]") {
    Rng rng(5);
    for (int k = 0; k < 20; ++k) {
        Corners corners = placed(random_star(12, rng), {0.2, 0.1, 1});
        for (Vec3& corner : corners)
            corner.z += 0.05 * rng.uniform();
        PolygonDivision division;
        const PolygonFlags flags = division.divide(corners);
        CHECK(flags.nonplanar);
        CHECK_FALSE(flags.crossing);
        CHECK(division.pieces().size() == corners.size() - 2);
        for (const PolygonDivision::Piece& piece : division.pieces())
            CHECK(piece[2] == piece[3]);
        CHECK(total_area(division, corners) >= shoelace(corners) * (1 - 1e-12));
    }
}

TEST_CASE("far from the origin polygons keep their area", "[polygon_division]") {
    Rng rng(11);
    for (int k = 0; k < 10; ++k) {
        const Corners corners = placed(random_star(40, rng), {1, 1, 2}, {1e6, -2e6, 3e6});
        PolygonDivision division;
        const PolygonFlags flags = division.divide(corners);
        CHECK_FALSE(flags.nonplanar);
        CHECK(total_area(division, corners) == Approx(shoelace(corners)).epsilon(1e-8));
    }
}

namespace {

/// Back and forth between two sides, obliquely: each edge's box lies over those of many others.
Flat saw(std::size_t teeth) {
    Flat flat;
    for (std::size_t k = 0; k < teeth; ++k) {
        const double x = double(k) / double(teeth);
        flat.emplace_back(x, x + (k % 2 == 0 ? 0 : .5));
    }
    flat.emplace_back(2, 0);
    flat.emplace_back(0, -1);
    return flat;
}

/// From near the centre out and back: the box of an edge lies over those of many others.
Flat spikes(std::size_t n) {
    Flat flat = regular(n);
    for (std::size_t k = 0; k < n; k += 2)
        flat[k] *= .001;
    return flat;
}

Flat scribble_of(std::size_t n) {
    Rng rng(11);
    Flat flat;
    for (std::size_t k = 0; k < n; ++k)
        flat.emplace_back(rng.uniform(), rng.uniform());
    return flat;
}

/// Every second corner of a regular polygon but one: each edge crosses almost all others.
Flat star(std::size_t n) {
    const Flat round = regular(n);
    Flat flat;
    for (std::size_t k = 0; k < n; ++k)
        flat.push_back(round[k * (n / 2) % n]);
    return flat;
}

} // namespace

TEST_CASE("the work of a polygon with many corners grows as their number", "[polygon_division]") {
    for (const std::size_t n : {10'001u, 40'001u})
        for (const Flat& flat : {saw(n), scribble_of(n), star(n)}) {
            PolygonDivision division;
            const DivisionWork before = division.work;
            const PolygonFlags flags = division.divide(placed(flat));
            CHECK_FALSE(flags.unfinished);
            CHECK(division.pieces().size() + 2 >= flat.size() / 2);
            CHECK(before.divide + DivisionWork::divide_each * n - division.work.divide <= 600 * n);
        }
}

TEST_CASE("a polygon with more long edges than can be compared is reported as unchecked",
          "[polygon_division]") {
    PolygonDivision division;
    CHECK_FALSE(division.divide(placed(spikes(4000))).unchecked);
    division.work.compare = 0; // as after many such faces
    const PolygonFlags flags = division.divide(placed(spikes(4000)));
    CHECK(flags.unchecked);
    CHECK_FALSE(flags.crossing);
    CHECK_FALSE(flags.unfinished);
}

TEST_CASE("ears are cut as far as the work allowed, and then without a search",
          "[polygon_division]") {
    const Flat flat = saw(501);
    EarClipper clipper;
    std::uint64_t work = 100;
    CHECK(clipper.clip(flat, 1e-16, work).size() > 10);
    CHECK(work == 0);
}
