// View factors between polygons against closed forms. C numbers are those of Howell's catalogue of
// radiation configuration factors; strips of great length stand for two dimensions, where Hottel's
// crossed strings are exact.
#include "radiosity/engine/factors/rows/view_factors.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"
#include "support/bare_scene.h"
#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

using namespace hemilux;
using test::opposed_rectangles;
using test::perpendicular_rectangles;

namespace {

/// The third of the polygons and those after it may be sheets with two sides.
Scene scene_of(const std::vector<Polygon>& polygons, bool sheets = false) {
    Scene scene = test::bare_scene();
    for (const Polygon& polygon : polygons) {
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        scene.vertices.insert(scene.vertices.end(), polygon.corner.begin(), polygon.corner.end());
        const std::uint32_t last = polygon.is_triangle() ? first + 2 : first + 3;
        const std::uint32_t face = scene.faces++;
        scene.facets.push_back(
            {{first, first + 1, first + 2, last}, face, 0, 0, sheets && face > 1});
    }
    return scene;
}

ViewFactors factors_of(const test::Model& model, const ExchangeOptions& options = {},
                       std::vector<std::uint32_t> row_of = {}, unsigned threads = 1) {
    if (row_of.empty())
        for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
            row_of.push_back(i);
    Monitor monitor;
    return view_factors(model.mesh, model.bvh, row_of, *std::ranges::max_element(row_of) + 1,
                        options, Workers(threads), monitor);
}

/// F from the first polygon to the second, of all that there are.
OpenShare first_to_second(const std::vector<Polygon>& polygons) {
    const test::Model model(scene_of(polygons, true));
    return factors_of(model).between(0, 1);
}

void check_exact(const std::vector<Polygon>& polygons, double expected) {
    const OpenShare found = first_to_second(polygons);
    CHECK(found.factor == Approx(expected).margin(1e-9).epsilon(0));
    CHECK(found.standard_error < 1e-9);
}

/// A rectangle at height z, seen from above where `up`.
Polygon level(double x0, double x1, double y0, double y1, double z, bool up) {
    const Polygon polygon{{Vec3(x0, y0, z), Vec3(x1, y0, z), Vec3(x1, y1, z), Vec3(x0, y1, z)}};
    return up ? polygon : polygon.flipped();
}

/// A rectangle in the plane x = 0 that faces +x.
Polygon upright(double y0, double y1, double z0, double z1) {
    return {{Vec3(0, y0, z0), Vec3(0, y1, z0), Vec3(0, y1, z1), Vec3(0, y0, z1)}};
}

/// A strip along y, in cross-section from (x0, z0) to (x1, z1); it faces left of that way.
Polygon strip(double x0, double z0, double x1, double z1, double half = 5e4) {
    return {{Vec3(x0, half, z0), Vec3(x0, -half, z0), Vec3(x1, -half, z1), Vec3(x1, half, z1)}};
}

/// Parallel rectangles [x] x [y] at 0 and [u] x [v] at height c: the sum over corners that Howell
/// gives for rectangles at any offset (C-13).
double offset_parallel(const std::array<double, 2>& x, const std::array<double, 2>& y,
                       const std::array<double, 2>& u, const std::array<double, 2>& v, double c) {
    const auto corner = [c](double a, double b) {
        const double p = std::sqrt(a * a + c * c), q = std::sqrt(b * b + c * c);
        return (b * p * std::atan(b / p) + a * q * std::atan(a / q) -
                c * c / 2 * std::log(a * a + b * b + c * c)) /
               (2 * std::numbers::pi);
    };
    double sum = 0;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            for (int k = 0; k < 2; ++k)
                for (int l = 0; l < 2; ++l)
                    sum += ((i + j + k + l) % 2 == 0 ? 1 : -1) * corner(x[i] - u[k], y[j] - v[l]);
    return sum / ((x[1] - x[0]) * (y[1] - y[0]));
}

} // namespace

TEST_CASE("View factors: opposed rectangles, C-11") {
    check_exact({level(0, 1, 0, 1, 0, true), level(0, 1, 0, 1, 1, false)},
                opposed_rectangles(1, 1));
    check_exact({level(0, 2, 0, 1, 0, true), level(0, 2, 0, 1, 1, false)},
                opposed_rectangles(2, 1));
    check_exact({level(0, 5, 0, 5, 0, true), level(0, 5, 0, 5, 1, false)},
                opposed_rectangles(5, 5));
    check_exact({level(0, 1, 0, 1, 0, true), level(0, 1, 0, 1, 20, false)},
                opposed_rectangles(.05, .05));
    CHECK(opposed_rectangles(.05, .05) == Approx(8e-4).epsilon(.01));
}

TEST_CASE("View factors: opposed rectangles almost in contact, C-11") {
    check_exact({level(0, 1, 0, 1, 0, true), level(0, 1, 0, 1, 1e-3, false)},
                opposed_rectangles(1e3, 1e3));
}

TEST_CASE("View factors: perpendicular rectangles with a common edge, C-14") {
    for (const auto& [h, w] : {std::array{1.0, 1.0}, {2.0, 1.0}, {1.0, 2.0}, {.5, .5}, {.01, 3.0}})
        check_exact({level(0, w, 0, 1, 0, true), upright(0, 1, 0, h)},
                    perpendicular_rectangles(h, w));
}

TEST_CASE("View factors: perpendicular rectangles apart, by the algebra of factors, C-15") {
    // From [1,2] to the wall: what [0,2] sends less what [0,1] sends.
    const double expected = 2 * perpendicular_rectangles(1, 2) - perpendicular_rectangles(1, 1);
    check_exact({level(1, 2, 0, 1, 0, true), upright(0, 1, 0, 1)}, expected);
    // From [0,1] to the upper half of a wall of height 2.
    check_exact({level(0, 1, 0, 1, 0, true), upright(0, 1, 1, 2)},
                perpendicular_rectangles(2, 1) - perpendicular_rectangles(1, 1));
}

TEST_CASE("View factors: parallel rectangles at any offset, C-13") {
    check_exact({level(0, 1, 0, 1, 0, true), level(2, 3, 1, 4, 1.5, false)},
                offset_parallel({0, 1}, {0, 1}, {2, 3}, {1, 4}, 1.5));
    check_exact({level(0, 2, 0, 1, 0, true), level(.5, 1, .25, .75, .2, false)},
                offset_parallel({0, 2}, {0, 1}, {.5, 1}, {.25, .75}, .2));
    CHECK(offset_parallel({0, 1}, {0, 1}, {0, 1}, {0, 1}, 1) ==
          Approx(opposed_rectangles(1, 1)).epsilon(1e-12));
}

TEST_CASE("View factors: parallel strips, C-1") {
    // F = sqrt(1 + H^2) - H with H = h / w, between infinite strips.
    for (const double h : {.5, 1.0, 3.0})
        check_exact({strip(0, 0, 1, 0), strip(1, h, 0, h)}, opposed_rectangles(1 / h, 1e5 / h));
    CHECK(opposed_rectangles(1, 1e5) == Approx(std::numbers::sqrt2 - 1).margin(1e-5));
}

TEST_CASE("View factors: strips that meet at an angle, C-5a") {
    // F = 1 - sin(alpha / 2) for equal strips; ends cost less than the strips are narrow.
    for (const double degrees : {30.0, 60.0, 90.0, 150.0}) {
        const double alpha = degrees * std::numbers::pi / 180;
        const OpenShare found =
            first_to_second({strip(0, 0, 1, 0), strip(std::cos(alpha), std::sin(alpha), 0, 0)});
        CHECK(found.factor == Approx(1 - std::sin(alpha / 2)).margin(1e-5));
        CHECK(found.standard_error == 0);
    }
}

TEST_CASE("View factors: a prism of strips, C-6") {
    // In a triangle of sides a, b, c: F_ab = (a + b - c) / (2 a).
    const double a = 4, b = 3, c = 5;
    const test::Model model(scene_of({strip(0, 0, a, 0), strip(0, b, 0, 0), strip(a, 0, 0, b)}));
    const ViewFactors factors = factors_of(model);
    CHECK(factors.between(0, 1).factor == Approx((a + b - c) / (2 * a)).margin(2e-5));
    CHECK(factors.between(0, 2).factor == Approx((a + c - b) / (2 * a)).margin(2e-5));
    CHECK(factors.between(2, 1).factor == Approx((c + b - a) / (2 * c)).margin(2e-5));
}

TEST_CASE("View factors: a groove to the sky") {
    // A V of two strips of 1 m at 60 degrees: the strips send 1/2 to each other and 1/2 out.
    const double h = std::sqrt(3) / 2;
    const test::Model model(scene_of({strip(-.5, h, 0, 0), strip(0, 0, .5, h)}));
    const ViewFactors factors = factors_of(model);
    const auto sky = factors.open[0][static_cast<std::size_t>(Open::sky)];
    CHECK(factors.between(0, 1).factor == Approx(.5).margin(1e-5));
    CHECK(sky.factor == Approx(.5).margin(1e-5 + 3 * sky.standard_error));
}

TEST_CASE("View factors: strips with a blocker, by crossed strings") {
    // Strips of width 1 at distance 1, and half of the way between them a strip from the middle to
    // beyond one side: what is left passes on the other side. Strings: crossed ones of length
    // sqrt(2), once straight and once around the blocker's edge; uncrossed ones of length 1, and
    // two of sqrt(1/2) around it.
    const std::vector<Polygon> polygons = {strip(0, 0, 1, 0), strip(1, 1, 0, 1),
                                           strip(.5, .5, 2, .5)};
    const OpenShare found = first_to_second(polygons);
    CHECK(found.standard_error > 0);
    CHECK(found.standard_error < 5e-3);
    // (crossed - uncrossed) / 2 with the taut string around the edge at (1/2, 1/2).
    const double expected = (2 * std::numbers::sqrt2 - 1 - 2 * std::sqrt(.5)) / 2;
    CHECK(expected == Approx(.20710678).margin(1e-8));
    CHECK(found.factor == Approx(expected).margin(3 * found.standard_error + 1e-5));
}

namespace {

/// What a centred square of side s, halfway between opposed unit squares at distance 1, hides. The
/// kernel depends on the offset d of two points alone, so the points of each offset that see the
/// blocker are counted by length along either axis, and the rest is an integral over offsets.
double hidden_by_square(double s) {
    constexpr int n = 400;
    const double low = .5 - s / 2, high = .5 + s / 2;
    std::vector<double> length(n), offset(n);
    for (int k = 0; k < n; ++k) {
        const double d = offset[k] = -1 + (k + .5) * 2 / n;
        length[k] =
            std::max(0.0, std::min({1.0, 1 - d, high - d / 2}) - std::max({0.0, -d, low - d / 2}));
    }
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double square = offset[i] * offset[i] + offset[k] * offset[k] + 1;
            sum += length[i] * length[k] / (square * square);
        }
    return sum * 4 / (n * n) / std::numbers::pi;
}

} // namespace

TEST_CASE("View factors: a square between squares") {
    for (const double side : {.25, .5, .9}) {
        const double low = .5 - side / 2, high = .5 + side / 2;
        const OpenShare found =
            first_to_second({level(0, 1, 0, 1, 0, true), level(0, 1, 0, 1, 1, false),
                             level(low, high, low, high, .5, true)});
        const double expected = opposed_rectangles(1, 1) - hidden_by_square(side);
        CHECK(found.standard_error > 0);
        CHECK(found.standard_error < std::max(.012 * expected, 6e-4));
        CHECK(found.factor == Approx(expected).margin(3 * found.standard_error));
    }
}

TEST_CASE("View factors: triangles, by halves of a square") {
    // Half of a unit square sends half of what the whole sends to the opposed one; by symmetry each
    // half does.
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
    const test::Model model(
        scene_of({{{a, b, c, c}}, {{a, c, d, d}}, level(0, 1, 0, 1, 1, false)}));
    const ViewFactors factors = factors_of(model);
    for (std::uint32_t half = 0; half < 2; ++half)
        CHECK(factors.between(half, 2).factor ==
              Approx(opposed_rectangles(1, 1)).margin(1e-9).epsilon(0));
}

TEST_CASE("View factors: a wall that reaches behind another's plane") {
    // Only the half of the wall above the floor's plane counts.
    check_exact({level(0, 1, 0, 1, 0, true), upright(0, 1, -1, 1)}, perpendicular_rectangles(1, 1));
}

TEST_CASE("View factors: a cube in a cube, by groups") {
    Scene scene = test::box_room(Vec3(-1), Vec3(1), 2, {Material{}}, {});
    const auto outer = static_cast<std::uint32_t>(scene.facets.size());
    test::add_cube(scene, Vec3(.1, 0, -.2), .4);
    const test::Model model(std::move(scene));
    std::vector<std::uint32_t> row_of(model.mesh.patches().size(), 0);
    for (std::uint32_t i = outer; i < row_of.size(); ++i)
        row_of[i] = 1;
    const ViewFactors factors = factors_of(model, {}, row_of);
    // The inner cube is convex and sees the outer one alone; areas are as 4 to .64.
    CHECK(factors.between(1, 0).factor == Approx(1).margin(1e-12));
    CHECK(factors.between(0, 1).factor == Approx(.16).margin(1e-12));
    CHECK(factors.between(0, 0).factor == Approx(.84).margin(1e-12));
    CHECK(factors.between(1, 1).factor == 0);
}

TEST_CASE("View factors: a box has six exact rows") {
    const test::Model model(test::box_room(Vec3(0), Vec3(1), 1, {Material{}}, {}));
    const ViewFactors factors = factors_of(model);
    for (std::uint32_t i = 0; i < 6; ++i) {
        CHECK(factors.row_sum(i) == Approx(1).margin(1e-12));
        for (std::uint32_t j = 0; j < 6; ++j)
            if (i != j)
                CHECK(factors.between(i, j).factor == Approx(i / 2 == j / 2
                                                                 ? opposed_rectangles(1, 1)
                                                                 : perpendicular_rectangles(1, 1))
                                                          .margin(1e-9));
    }
}
