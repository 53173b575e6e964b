// Form factors by contour integration, against closed forms and against plain quadrature.
#include "radiosity/engine/factors/pairs/exchange_area.h"
#include "radiosity/engine/form_factors/exact_form_factors.h"
#include "radiosity/engine/form_factors/matrix_quality.h"
#include "radiosity/engine/linear/gmres.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/directions.h"
#include "support/scenes.h"
#include "support/solve.h"

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

struct Sampled {
    test::Model model;
    Workers workers{2};
    Monitor monitor;
    SampledFormFactors samples;
    ExactFormFactors exact;
    SparseMatrix matrix;

    Sampled(Scene scene, std::uint32_t rays, const MeshOptions& options = {})
        : model(std::move(scene), options), samples(model.mesh, model.bvh, {}, 5),
          exact(model.mesh, workers, monitor) {
        samples.trace_up_to(rays, workers, monitor);
        matrix = exact.matrix(samples);
    }
};

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

TEST_CASE("A cube is solved exactly") {
    // 96 patches; the means over floor, ceiling and walls are known from an independent solution.
    const Sampled cube(test::cube_with_lit_floor(4, .5), 1);
    CHECK(cube.exact.sampled_pairs() == 0);
    CHECK(cube.exact.exact_pairs() == 96 * 80 / 2);
    const MatrixQuality quality = assess_matrix(cube.matrix, cube.model.mesh, cube.samples.lost());
    CHECK(quality.closure_most < 1e-8);
    CHECK(quality.reciprocity_most < 1e-12);
    std::vector<double> emission(96, 0.0), x(96, 0.0);
    for (std::size_t i = 0; i < 16; ++i)
        emission[i] = 1;
    const GmresResult result = gmres(
        [&](const std::vector<double>& b, std::vector<double>& y) {
            cube.matrix.multiply(b, y, cube.workers);
            for (std::size_t i = 0; i < b.size(); ++i)
                y[i] = b[i] - .5 * y[i];
        },
        emission, x);
    CHECK(result.converged);
    const auto mean = [&](std::size_t face) {
        double sum = 0;
        for (std::size_t i = 0; i < 16; ++i)
            sum += x[16 * face + i] / 16;
        return sum;
    };
    CHECK(mean(0) == Approx(1.10264571).margin(1e-8));
    CHECK(mean(1) == Approx(.17182942).margin(1e-8));
    for (std::size_t wall = 2; wall < 6; ++wall)
        CHECK(mean(wall) == Approx(.18138122).margin(1e-8));
}

TEST_CASE("Only pairs with something between them are sampled") {
    Scene scene = test::cube_with_lit_floor(1, .5);
    const Sampled empty(scene, 1);
    CHECK(empty.exact.exact_pairs() == 15);
    CHECK(empty.exact.sampled_pairs() == 0);
    // A small plate in the middle, its front up: between any two opposite faces, and adjoining ones
    // too, whose boxes are the whole cube.
    test::add_quad(scene, {.4, .5, .4}, {.4, .5, .6}, {.6, .5, .6}, {.6, .5, .4}, 1, 1, 0);
    const Sampled plate(scene, 64);
    CHECK(plate.exact.exact_pairs() == 5); // the plate with all but the floor
    CHECK(plate.exact.sampled_pairs() == 15);
}

TEST_CASE("In a room with obstacles the exact factors are those of many rays") {
    const Sampled room(test::room_with_block(), 1u << 12);
    CHECK(room.exact.exact_pairs() > 1000);
    CHECK(room.exact.sampled_pairs() > 1000);
    const MatrixQuality quality = assess_matrix(room.matrix, room.model.mesh, room.samples.lost());
    CHECK(quality.closure_most < .02); // rows without a sampled pair keep what rays lost by chance
    CHECK(quality.least > 0);
    CHECK(quality.most < 1);
    // Both matrices applied to a smooth vector: the light that arrives.
    const SparseMatrix drawn = room.samples.matrix();
    const std::size_t n = room.matrix.rows();
    std::vector<double> light(n), a(n), b(n);
    for (std::size_t i = 0; i < n; ++i)
        light[i] = room.model.mesh.patches()[i].centre.x + 2;
    room.matrix.multiply(light, a, room.workers);
    drawn.multiply(light, b, room.workers);
    for (std::size_t i = 0; i < n; ++i)
        CHECK(a[i] == Approx(b[i]).epsilon(.01));
}
