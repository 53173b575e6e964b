// Closed rooms that reflect nearly all: there the tail of the series of bounces is the solution,
// and the smallest loss of energy between patches would be multiplied by 1 / (1 - rho).
#include "radiosity/engine/form_factors/factor_options.h"
#include "radiosity/engine/solving/own_options.h"
#include "support/catch.h"
#include "support/layered_model.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>

using namespace hemilux;
using Model = test::LayeredModel;

namespace {

/// Without chance: in a convex room all factors are known.
Solution exact_solution(const Model& model) {
    SolveOptions options;
    set_own_options(options, FactorOptions{.kind = FactorKind::exact});
    return test::solve(model, *find_method("matrix"), options, test::steps(1));
}

double relative_error(const Model& model, const Solution& s, const Solution& exact) {
    return true_error(model.mesh, s.radiosity, exact.radiosity).all;
}

} // namespace

TEST_CASE("Stored transport needs no more rays for bright rooms than for dim ones", "[slow]") {
    double rays_when_dim = 0;
    for (const double rho : {.5, .9, .99, .999, .9999}) {
        const Model model(test::cube_with_lit_floor(6, rho));
        const Solution exact = exact_solution(model);
        double rays = 0, squares = 0;
        constexpr int runs = 3;
        for (int run = 0; run < runs; ++run) {
            SolveOptions options;
            options.seed = 1 + std::uint64_t(run);
            const Solution s =
                test::solve_as_needed(model, *find_method("stored-transport"), options,
                                      {.steps = {}, .seconds = {}, .error = .008});
            rays += static_cast<double>(s.rays_energy) / runs;
            squares += std::pow(relative_error(model, s, exact), 2) / runs;
            for (int c = 0; c < 3; ++c)
                CHECK(s.energy.absorbed[c] == Approx(s.energy.emitted[c]).epsilon(1e-4));
        }
        CAPTURE(rho, rays, rays_when_dim);
        CHECK(std::sqrt(squares) < .01);
        if (rho == .5)
            rays_when_dim = rays;
        CHECK(rays <= 3 * rays_when_dim);
        for (int c = 0; c < 3; ++c)
            CHECK(exact.energy.absorbed[c] == Approx(exact.energy.emitted[c]).epsilon(1e-6));
    }
}

TEST_CASE("Bright rooms of which parts are black, or no two patches alike") {
    for (const double rho : {.99, .9999}) {
        Scene scene = test::cube_with_lit_floor(5, rho);
        scene.materials.push_back({"black", Vec3(0.0), Vec3(0.0)});
        scene.materials.push_back({"red", Vec3(rho, .1, 0), Vec3(0.0)});
        for (std::size_t f = 30; f < scene.facets.size(); f += 7)
            scene.facets[f].material = f % 2 == 0 ? 2 : 3;
        const Model model(scene);
        const Solution exact = exact_solution(model);
        const Solution s = test::solve(model, *find_method("stored-transport"), {}, test::steps(7));
        CAPTURE(rho);
        CHECK(relative_error(model, s, exact) < .02);
    }
}

TEST_CASE("All methods hold in a room of reflectance .99", "[slow]") {
    const Model model(test::cube_with_lit_floor(3, .99));
    const Solution exact = exact_solution(model);
    for (const Method* const method : methods()) {
        SolveOptions options;
        options.rays = 256;
        options.seed = 2;
        const StopRule stop = method->default_stop.error
                                  ? StopRule{.steps = {}, .seconds = {}, .error = .01}
                                  : test::steps(40);
        const Solution s = test::solve(model, *method, options, stop);
        const double off = relative_error(model, s, exact);
        const double reported = estimated_error(model.mesh, s);
        CAPTURE(method->name, off, reported);
        CHECK(off < .06);
        CHECK(off < 3.5 * reported + 1e-6);
    }
}
