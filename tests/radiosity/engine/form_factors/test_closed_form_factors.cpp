// Form factors by integrals, closed: where all are exact, where some are hidden in part, and where
// light is lost.
#include "radiosity/engine/form_factors/closed_form_factors.h"
#include "radiosity/engine/form_factors/matrix_quality.h"
#include "radiosity/engine/form_factors/sampled_form_factors.h"
#include "radiosity/engine/linear/gmres.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

using namespace hemilux;

namespace {

struct Closed {
    test::Model model;
    Workers workers{2};
    Monitor monitor;
    ClosedFormFactors exact;
    SparseMatrix matrix;
    MatrixQuality quality;

    explicit Closed(Scene scene, std::uint32_t rays = ClosedFormFactors::min_rays,
                    const MeshOptions& options = {})
        : model(std::move(scene), options), exact(model.mesh, model.bvh, workers, monitor) {
        ClosedFactors factors =
            exact.batch(5, rays, relative_above(.01, 1e-3), workers, monitor).value();
        quality = assess_matrix(factors.matrix, model.mesh, factors.lost);
        matrix = std::move(factors.matrix);
    }
};

} // namespace

TEST_CASE("A cube is solved exactly") {
    // 96 patches; the means over floor, ceiling and walls are known from an independent solution.
    const Closed cube(test::cube_with_lit_floor(4, .5));
    CHECK(cube.exact.other_pairs() == 0);
    CHECK(cube.exact.clear_pairs() == 96 * 80 / 2);
    CHECK(cube.quality.closure_most < 1e-12);
    CHECK(cube.quality.reciprocity_most < 1e-14);
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

TEST_CASE("Only pairs with something between them are not exact") {
    Scene scene = test::cube_with_lit_floor(1, .5);
    const Closed empty(scene);
    CHECK(empty.exact.clear_pairs() == 15);
    CHECK(empty.exact.other_pairs() == 0);
    // A small plate in the middle, its front up: between any two opposite faces, and adjoining ones
    // too, whose boxes are the whole cube.
    test::add_quad(scene, {.4, .5, .4}, {.4, .5, .6}, {.6, .5, .6}, {.6, .5, .4}, 1, 1, 0);
    const Closed plate(scene);
    CHECK(plate.exact.clear_pairs() == 5); // the plate with all but the floor
    CHECK(plate.exact.other_pairs() == 15);
}

TEST_CASE("In a room with obstacles the factors are those of many rays") {
    const Closed room(test::room_with_block(), 1U << 12);
    CHECK(room.exact.clear_pairs() > 1000);
    CHECK(room.exact.other_pairs() > 1000);
    CHECK(room.quality.closure_most < 1e-12);
    CHECK(room.quality.reciprocity_most < 1e-14);
    CHECK(room.quality.least > 0);
    CHECK(room.quality.most < 1);
    // Both matrices applied to a smooth vector: the light that arrives.
    SampledFormFactors samples(room.model.mesh, room.model.bvh, {}, 5);
    Monitor monitor;
    samples.trace_up_to(1U << 12, room.workers, monitor);
    const SparseMatrix drawn = samples.matrix();
    const std::size_t n = room.matrix.rows();
    std::vector<double> light(n), a(n), b(n);
    for (std::size_t i = 0; i < n; ++i)
        light[i] = room.model.mesh.patches()[i].centre.x + 2;
    room.matrix.multiply(light, a, room.workers);
    drawn.multiply(light, b, room.workers);
    for (std::size_t i = 0; i < n; ++i)
        CHECK(a[i] == Approx(b[i]).epsilon(.01));
}

TEST_CASE("Factors of pairs that are hidden in part are right on average over seeds") {
    const test::Model model(test::room_with_block());
    const Workers workers(2);
    Monitor monitor;
    const ClosedFormFactors exact(model.mesh, model.bvh, workers, monitor);
    const std::size_t n = model.mesh.patches().size();
    constexpr unsigned seeds = 24;
    std::vector<double> sum(n * n), squares(n * n);
    const auto batch = [&](std::uint64_t seed, const FactorTolerance& tolerance) {
        return exact.batch(seed, ClosedFormFactors::min_rays, tolerance, workers, monitor)
            .value()
            .matrix;
    };
    const auto rough = [](std::uint32_t, std::uint32_t, double) { return .01; };
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const SparseMatrix f = batch(seed, {.01, rough});
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = f.row_begin[i]; k < f.row_begin[i + 1]; ++k) {
                sum[i * n + f.column[k]] += f.value[k] / seeds;
                squares[i * n + f.column[k]] += f.value[k] * f.value[k] / seeds;
            }
    }
    const SparseMatrix truth = batch(99, relative_above(.001, 1e-4));
    // Where pairs are hidden in part, the sum of squares of the means' errors over what they
    // spread by is near to what independent seeds let expect.
    double off = 0, expected = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = truth.row_begin[i]; k < truth.row_begin[i + 1]; ++k) {
            const std::size_t at = i * n + truth.column[k];
            const double error = sum[at] - truth.value[k];
            off += error * error;
            expected += (squares[at] - sum[at] * sum[at]) / (seeds - 1);
        }
    CHECK(off < 1.3 * expected);
    CHECK(off > .5 * expected);
}
