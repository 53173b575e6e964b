// Form factors by hemicubes: delta factors and closed forms, convergence to the exact factors, what
// pixels miss, and the methods that solve with them.
#include "geometry/compensated_sum.h"
#include "radiosity/engine/factors/points/hemicube.h"
#include "radiosity/engine/form_factors/closed_form_factors.h"
#include "radiosity/engine/form_factors/factor_options.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/directions.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

using namespace hemilux;

namespace {

struct Cubes {
    Workers workers{2};
    Monitor monitor;
    HemicubeFormFactors factors;

    Cubes(const test::Model& model, std::uint32_t edge)
        : factors(hemicube_form_factors(Hemicube(edge), model.mesh, model.bvh, workers, monitor)) {}
};

double entry(const SparseMatrix& matrix, std::size_t i, std::uint32_t j) {
    for (std::size_t k = matrix.row_begin[i]; k < matrix.row_begin[i + 1]; ++k)
        if (matrix.column[k] == j)
            return matrix.value[k];
    return 0;
}

double row_sum(const SparseMatrix& matrix, std::size_t i) {
    CompensatedSum<double> sum;
    for (std::size_t k = matrix.row_begin[i]; k < matrix.row_begin[i + 1]; ++k)
        sum += matrix.value[k];
    return sum.value();
}

/// Of patch 0, which is to see patch 1 at the most.
struct FirstRow {
    double factor = 0;
    EscapeFraction lost;

    FirstRow(const test::Model& model, std::uint32_t edge) {
        const StopFlag never;
        const HemicubeRow row =
            hemicube_row(Hemicube(edge), model.mesh, model.bvh, 0, Workers(2), never);
        for (const HemicubeRow::Entry& e : row.entries) {
            REQUIRE(e.patch == 1);
            factor = e.factor;
        }
        lost = row.lost;
    }
};

SolveOptions with_hemicubes(std::uint32_t edge) {
    SolveOptions options;
    set_own_options(options, FactorOptions{FactorKind::hemicube, edge});
    return options;
}

Scene two_quads(const Polygon& first, const Polygon& second) {
    Scene scene;
    scene.materials = {{"white", Vec3(.5), Vec3(1.0)}};
    scene.groups = {"default"};
    for (const Polygon& p : {first, second})
        test::add_quad(scene, p.corner[0], p.corner[1], p.corner[2], p.corner[3], 1, 1, 0);
    return scene;
}

/// A small floor patch, patch 0, facing up.
const Polygon small_floor{{Vec3(-.01, -.01, 0), {.01, -.01, 0}, {.01, .01, 0}, {-.01, .01, 0}}};

/// How far the factors are from the exact ones of an empty room, over all pairs.
double rms_error(const test::Model& model, const SparseMatrix& exact, std::uint32_t edge) {
    const Cubes cubes(model, edge);
    const auto n = static_cast<std::uint32_t>(exact.rows());
    double squares = 0;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
            squares += std::pow(entry(cubes.factors.matrix, i, j) - entry(exact, i, j), 2);
    return std::sqrt(squares / (double(n) * n));
}

} // namespace

TEST_CASE("Delta factors are positive, symmetric and sum to 1") {
    for (const std::uint32_t edge : {2u, 4u, 6u, 10u, 64u, 100u, 256u}) {
        CAPTURE(edge);
        const Hemicube cube(edge);
        REQUIRE(cube.pixels() == 3u * edge * edge);
        CompensatedSum<double> sum;
        double least = 1;
        for (std::size_t k = 0; k < cube.pixels(); ++k) {
            sum += cube.delta_factor(k);
            least = std::min(least, cube.delta_factor(k));
        }
        CHECK(sum.value() == Approx(1).margin(1e-12));
        CHECK(least > 0);
        const std::size_t n = edge;
        const auto top = [&](std::size_t row, std::size_t column) {
            return cube.delta_factor(row * n + column);
        };
        bool symmetric = true;
        for (std::size_t row = 0; row < n; ++row)
            for (std::size_t column = 0; column < n; ++column) {
                symmetric = symmetric && top(row, column) == top(n - 1 - row, column) &&
                            top(row, column) == top(row, n - 1 - column) &&
                            top(row, column) == Approx(top(column, row)).epsilon(1e-9);
                for (std::size_t side = 0; side < 4 && row < n / 2; ++side) {
                    const auto on = [&](std::size_t s, std::size_t c) {
                        return cube.delta_factor(n * n + s * n * n / 2 + row * n + c);
                    };
                    symmetric = symmetric && on(side, column) == on(0, n - 1 - column);
                }
            }
        CHECK(symmetric);
    }
}

TEST_CASE("A delta factor is the integral of the cosine over its pixel, along its direction") {
    // The printed form of Cohen and Greenberg, area / (pi (x^2 + y^2 + 1)^2) on the top and
    // z area / (pi (y^2 + z^2 + 1)^2) on the sides, is the limit for small pixels.
    const Hemicube cube(256);
    const double area = 4.0 / (256.0 * 256.0);
    for (std::size_t k = 0; k < cube.pixels(); k += 97) {
        const Vec3 d = cube.direction(k);
        REQUIRE(std::max({std::abs(d.x), std::abs(d.y), d.z}) == 1);
        REQUIRE(d.z > 0);
        const double r_squared = glm::dot(d, d);
        const double printed = area * d.z / (std::numbers::pi * r_squared * r_squared);
        REQUIRE(cube.delta_factor(k) == Approx(printed).epsilon(1e-4));
    }
}

TEST_CASE("A hemicube has an even number of pixels along its edge") {
    for (const std::uint32_t edge : {0u, 1u, 3u, 65u, 1026u, 5000u}) {
        CHECK_FALSE(Hemicube::is_edge(edge));
        CHECK_THROWS_AS(Hemicube(edge), std::invalid_argument);
    }
    CHECK(Hemicube(1024).pixels() == 3u << 20);
}

TEST_CASE("Factors of a small patch converge to the closed form of its centre") {
    const Polygon ceiling{{Vec3(0, 0, 1), {0, 1.5, 1}, {2, 1.5, 1}, {2, 0, 1}}};
    const Polygon wall{{Vec3(.5, -1, 0), {.5, 2, 0}, {.5, 2, 1.5}, {.5, -1, 1.5}}};
    for (const Polygon& other : {ceiling, wall.flipped(), wall}) {
        const test::Model model(two_quads(small_floor, other));
        const Vec3 below = model.mesh.patches()[0].centre, up(0, 0, 1);
        const Patch& seen = model.mesh.patches()[1];
        const bool front = glm::dot(seen.normal, below - seen.centre) > 0;
        const double exact = front ? test::point_to_polygon(below, up, seen.shape) : 0;
        CAPTURE(exact);
        for (const std::uint32_t edge : {8u, 32u, 128u, 512u}) {
            const auto [factor, lost] = FirstRow(model, edge);
            // Pixels that the outline cuts: some edges of the cube, each of a share 1 / edge of it.
            CHECK(factor == Approx(exact).margin(.5 / edge));
            CHECK(factor + lost.escaped + lost.absorbed == Approx(1).margin(1e-11));
            if (!front)
                CHECK(lost.absorbed > .1);
        }
    }
    CHECK(test::point_under_corner(2, 1.5) ==
          Approx(test::point_to_polygon(Vec3(0.0), {0, 0, 1}, ceiling)).epsilon(1e-12));
}

TEST_CASE("Between large rectangles the centre stands for the patch, and division ends that") {
    const Polygon floor{{Vec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    const Polygon ceiling{{Vec3(0, 0, 1), {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}};
    const Polygon wall{{Vec3(0, 0, 0), {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}};
    const auto off = [&](const Polygon& other, double exact, double max_edge) {
        const test::Model model(two_quads(floor, other), {.max_edge = max_edge});
        const Cubes cubes(model, 64);
        double sum = 0;
        for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
            if (model.mesh.patches()[i].facet == 0)
                sum += model.mesh.patches()[i].area * row_sum(cubes.factors.matrix, i);
        double area = 0;
        for (const Patch& patch : model.mesh.patches())
            area += patch.facet == 0 ? patch.area : 0;
        return std::abs(sum / area - exact);
    };
    for (const auto& [other, exact] : {std::pair{ceiling, test::opposed_rectangles(1, 1)},
                                       {wall, test::perpendicular_rectangles(1, 1)}}) {
        CAPTURE(exact);
        const double whole = off(other, exact, 0), divided = off(other, exact, .26);
        CHECK(whole > .009); // .2395 for .1998, and .1901 for .2000
        CHECK(divided < .1 * whole);
    }
}

TEST_CASE("Rows of a closed room sum to 1, those of an open one with what is lost") {
    for (const auto& [scene, closed] :
         {std::pair{test::furnace_l_shape(.5), true}, {test::open_scene(), false}}) {
        const test::Model model(scene);
        const Cubes cubes(model, 30);
        double lost = 0;
        for (std::size_t i = 0; i < model.mesh.patches().size(); ++i) {
            const EscapeFraction& of_row = cubes.factors.lost[i];
            lost += of_row.sum();
            REQUIRE(row_sum(cubes.factors.matrix, i) + of_row.escaped + of_row.absorbed ==
                    Approx(1).margin(1e-12));
        }
        CHECK((lost == 0) == closed);
    }
}

TEST_CASE("More pixels bring factors nearer to the exact ones, until the centre is left",
          "[slow]") {
    const test::Model model(test::cube_with_lit_floor(3, .5));
    const Workers workers(2);
    Monitor monitor;
    const ClosedFormFactors exact(model.mesh, model.bvh, workers, monitor);
    REQUIRE(exact.other_pairs() == 0);
    const SparseMatrix truth =
        exact.batch(1, ClosedFormFactors::min_rays, relative_above(.01, 1e-3), workers, monitor)
            .value()
            .matrix;
    std::vector<double> error;
    for (const std::uint32_t edge : {4u, 16u, 64u, 128u})
        error.push_back(rms_error(model, truth, edge));
    CAPTURE(error);
    CHECK(error[1] < .5 * error[0]);
    CHECK(error[2] < error[1]);
    // What is left is the centre's: the factors of points, in closed form.
    double squares = 0;
    const auto patches = model.mesh.patches();
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        for (std::uint32_t j = 0; j < patches.size(); ++j) {
            const bool faces =
                glm::dot(patches[j].normal, patches[i].centre - patches[j].centre) > 1e-9;
            const double of_centre =
                faces
                    ? test::point_to_polygon(patches[i].centre, patches[i].normal, patches[j].shape)
                    : 0;
            squares += std::pow(of_centre - entry(truth, i, j), 2);
        }
    const double of_centres = std::sqrt(squares / double(patches.size() * patches.size()));
    CHECK(error[3] == Approx(of_centres).epsilon(.05));
    CHECK(error[3] > .9 * error[2]);
}

TEST_CASE("What is smaller than a pixel is missed or counts too much", "[slow]") {
    // Strips across the view of a small patch, a tenth of a pixel of the coarse cube wide.
    constexpr std::uint32_t coarse = 16, fine = 1024;
    Rng rng(3);
    int missed = 0, too_much = 0;
    for (int k = 0; k < 40; ++k) {
        const double x = 1.5 * rng.uniform() - .75, width = .1 * 2 / coarse;
        const Polygon strip{{Vec3(x, -.5, 1), {x, .5, 1}, {x + width, .5, 1}, {x + width, -.5, 1}}};
        const test::Model model(two_quads(small_floor, strip));
        const double exact = test::point_to_polygon(model.mesh.patches()[0].centre, {0, 0, 1},
                                                    model.mesh.patches()[1].shape);
        const double seen = FirstRow(model, coarse).factor;
        missed += seen < .1 * exact;
        too_much += seen > 2 * exact;
        if (k < 4) // pixels much smaller than the strip
            CHECK(FirstRow(model, fine).factor == Approx(exact).epsilon(.05));
    }
    CHECK(missed > 0);
    CHECK(too_much > 0);
}

TEST_CASE("Both methods with hemicubes solve a furnace, and do not claim an error") {
    const test::Model model(test::furnace_box(2, .5));
    for (const char* name : {"matrix", "progressive"}) {
        CAPTURE(name);
        const Method& method = *find_method(name);
        const Solution solution =
            test::solve(model, method, with_hemicubes(16), method.default_stop);
        const bool is_matrix = method.role == Role::reference;
        for (const Vec3& b : solution.radiosity)
            CHECK(b.x == Approx(2).epsilon(is_matrix ? 1e-10 : .15));
        for (const Vec3& error : solution.standard_error)
            CHECK(std::isnan(error.x));
        CHECK(std::isnan(estimated_error(model.mesh, solution)));
        CHECK(std::abs(solution.energy.imbalance()) < 1e-9);
        if (is_matrix)
            CHECK(solution.steps == 1);
    }
}

TEST_CASE("Progressive shots by hemicubes lose no light, and agree with the matrix", "[slow]") {
    const test::Model model(test::room_with_block());
    const Solution truth = test::reference(model, .02);
    for (const char* name : {"matrix", "progressive"}) {
        CAPTURE(name);
        const Method& method = *find_method(name);
        const Solution solution =
            test::solve(model, method, with_hemicubes(32), method.default_stop);
        CHECK(true_error(model.mesh, solution.radiosity, truth.radiosity).all < .1);
        const double emitted = solution.energy.emitted.x;
        CHECK(std::abs(solution.energy.unshot.x) <
              (method.role == Role::reference ? .02 : .006) * emitted);
    }
}

TEST_CASE("Solutions by hemicubes depend on neither seed nor threads") {
    const test::Model model(test::room_with_block());
    for (const char* name : {"matrix", "progressive"}) {
        CAPTURE(name);
        const auto radiosity = [&](std::uint64_t seed, unsigned threads) {
            SolveOptions options = with_hemicubes(10);
            options.seed = seed;
            options.threads = threads;
            return test::solve(model, *find_method(name), options, test::steps(3)).radiosity;
        };
        const std::vector<Vec3> one = radiosity(1, 1);
        CHECK(test::same_bits(one, radiosity(1, 2)));
        CHECK(test::same_bits(one, radiosity(7, 3)));
    }
}
