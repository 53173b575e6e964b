// A hundred white rooms in a row, joined by small doors: light takes long to get to the last one,
// so the linear systems have as many slow modes as there are rooms. What a solver leaves there is
// bounded by the residual over what is lost in each reflection.
#include "radiosity/engine/form_factors/exchange_matrix.h"
#include "radiosity/engine/form_factors/sampled_form_factors.h"
#include "radiosity/engine/linear/conjugate_gradients.h"
#include "radiosity/engine/linear/radiosity_system.h"
#include "radiosity/engine/linear/surfaces.h"
#include "radiosity/engine/needs/find_needs.h"
#include "support/catch.h"
#include "support/families/builders.h"
#include "support/layered_model.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>

using namespace hemilux;
using Model = test::LayeredModel;

namespace {

constexpr double white = 0.999999;

/// Unit cubes; in the walls between them are doors of 0.3 x 0.3. The first has a lamp.
Scene chain_of_rooms(std::uint32_t count) {
    Scene scene =
        test::with_materials({test::grey("wall", white, 0), test::grey("lamp", white, 10)});
    for (std::uint32_t k = 0; k < count; ++k) {
        const test::Inset door{Vec2(0.3), std::nullopt};
        std::vector<test::OddCell> odd;
        if (k > 0)
            odd.push_back({test::left, 0, 0, door});
        if (k + 1 < count)
            odd.push_back({test::right, 0, 0, door});
        if (k == 0)
            odd.push_back({test::ceiling, 0, 0, {Vec2(0.5), 1}});
        const Vec3 low(k, 0, 0);
        test::add_box(scene, low, low + Vec3(1.0), 1, 0, odd);
    }
    test::weld(scene);
    return scene;
}

} // namespace

TEST_CASE("The matrix of a hundred white rooms in a row is solved") {
    const Model model(chain_of_rooms(100));
    const Workers workers(2);
    Monitor monitor;
    SampledFormFactors samples(model.mesh, model.bvh, {}, 5);
    samples.trace_up_to(64, workers, monitor);
    const SparseMatrix f = samples.matrix();
    const std::size_t n = f.rows();
    const ArrivingLight light =
        arriving_light([&](auto x, auto y) { f.multiply(x, y, workers); }, model.mesh,
                       std::vector<Vec3>(n), find_needs(model.mesh));
    CHECK(light.unsolved == 0);
    std::vector<double> leaving(n), arriving(n);
    for (std::uint32_t i = 0; i < n; ++i)
        leaving[i] = model.mesh.material(i).emission.x + white * light.incident[i].x;
    f.multiply(leaving, arriving, workers);
    double max_off = 0, least = INFINITY;
    for (std::size_t i = 0; i < n; ++i) {
        max_off = std::max(max_off, std::abs(arriving[i] - light.incident[i].x));
        least = std::min(least, light.incident[i].x);
    }
    CAPTURE(max_off, least);
    CHECK(least > 0);
    CHECK(max_off / (1 - white) < 1e-4 * least); // rows sum to 1 at most: a bound of the error
}

TEST_CASE("Stored transport solves a hundred white rooms in a row") {
    const Model model(chain_of_rooms(100));
    const Workers workers(2);
    Monitor monitor;
    RayCounts rays(model.mesh, model.bvh, 5);
    const std::size_t n = model.mesh.patches().size();
    rays.trace_up_to(std::vector<std::uint32_t>(n, 64), workers, monitor);
    const Surfaces at(model.mesh);
    const ExchangeMatrix f(at.area, rays);
    std::vector<Vec3> direct(n), incident(n);
    f.multiply(at.emission, direct, workers);
    const GradientsResult result =
        solve_by_gradients(f, at.area, at.reflectance, direct, incident, workers, 1e-10);
    CAPTURE(result.iterations, result.residual);
    CHECK(result.converged);
    CHECK(result.residual <= 1e-10);
}

TEST_CASE("Where a solver ends before the light does, its bound holds") {
    // A row of patches, each of which sends a quarter of its light to each neighbour.
    const Model model(test::cube_with_lit_floor(20, white));
    const std::size_t n = model.mesh.patches().size();
    constexpr double passed = 0.25;
    const auto multiply = [n](std::span<const double> x, std::span<double> y) {
        for (std::size_t i = 0; i < n; ++i) {
            const double before = x[i > 0 ? i - 1 : 0], after = x[i + 1 < n ? i + 1 : n - 1];
            y[i] = x[i] + passed * (before - 2 * x[i] + after);
        }
    };
    const ArrivingLight light =
        arriving_light(multiply, model.mesh, std::vector<Vec3>(n), find_needs(model.mesh));
    // What arrives, h = F E + rho F h, by elimination in its three diagonals.
    std::vector<double> emission(n), right(n), diagonal(n), truth(n);
    for (std::uint32_t i = 0; i < n; ++i)
        emission[i] = model.mesh.material(i).emission.x;
    multiply(emission, right);
    constexpr double beside = -white * passed;
    for (std::size_t i = 0; i < n; ++i) {
        const double stays = 1 - passed * (i == 0 || i + 1 == n ? 1 : 2);
        diagonal[i] = 1 - white * stays;
        if (i > 0) {
            const double factor = beside / diagonal[i - 1];
            diagonal[i] -= factor * beside;
            right[i] -= factor * right[i - 1];
        }
    }
    for (std::size_t i = n; i-- > 0;)
        truth[i] = (right[i] - (i + 1 < n ? beside * truth[i + 1] : 0)) / diagonal[i];
    double squares = 0, size = 0;
    for (std::size_t i = 0; i < n; ++i) {
        squares += std::pow(light.incident[i].x - truth[i], 2);
        size += std::pow(light.incident[i].x, 2);
    }
    const double error = std::sqrt(squares / size);
    CAPTURE(error, light.unsolved);
    CHECK(light.unsolved > 0);
    CHECK(std::isfinite(light.unsolved));
    CHECK(error < 1.01 * light.unsolved);
}
