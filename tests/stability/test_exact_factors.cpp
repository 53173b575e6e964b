// `matrix` with exact factors where some pairs are hidden in part: what rays add must be right on
// average, and its error as small as it is reported.
#include "radiosity/engine/form_factors/factor_options.h"
#include "radiosity/engine/solving/own_options.h"
#include "support/catch.h"
#include "support/families/reliability.h"
#include "support/solve.h"

#include <cmath>
#include <string_view>
#include <utility>

using namespace hemilux;
using namespace hemilux::test;

namespace {

const HardScene& scene_named(std::string_view family, std::string_view name) {
    for (const HardSceneEntry& entry : hard_scenes())
        if (entry.family == family && entry.name == name)
            return hard_scene(entry);
    FAIL("no such scene");
    return hard_scene(hard_scenes().front());
}

/// Root mean squares over a few seeds.
struct Errors {
    double off = 0, reported = 0;
};

Errors errors_of(const PreparedScene& scene, FactorKind kind) {
    constexpr unsigned seeds = 4;
    Errors errors;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        SolveOptions options;
        options.seed = seed;
        options.rays = 64;
        options.threads = 2;
        set_own_options(options, FactorOptions{.kind = kind});
        Monitor monitor;
        const SolverInput input{scene.mesh(), scene.tracer(), options, monitor, scene.needs()};
        const auto solver = find_method("matrix")->make(input);
        run(*solver, input, steps(1));
        const JudgedRun judged = judge(scene, solver->solution());
        errors.off += judged.true_error * judged.true_error / seeds;
        errors.reported += judged.reported * judged.reported / seeds;
    }
    return {std::sqrt(errors.off), std::sqrt(errors.reported)};
}

} // namespace

TEST_CASE("Exact factors beside sampled ones are no worse than rays and as good as they report") {
    for (const auto& [family, name] :
         {std::pair{"pinhole", "0.001, reflectance 0.5"},
          std::pair{"shade", "0.1, reflectance 0.5"}, std::pair{"shade", "0.01, reflectance 0.9"},
          std::pair{"shade", "over ground, 0.1, reflectance 0.8"}}) {
        const PreparedScene scene(scene_named(family, name));
        const Errors rays = errors_of(scene, FactorKind::rays);
        const Errors exact = errors_of(scene, FactorKind::exact);
        CAPTURE(family, name, rays.off, exact.off, exact.reported);
        CHECK(exact.off < 2 * rays.off);
        CHECK(exact.off < 1.5 * exact.reported);
    }
}

TEST_CASE("In a convex room with a window exact factors show all that is lost") {
    const PreparedScene scene(scene_named("window", "reflectance 0.5, 1 cells open"));
    CHECK(errors_of(scene, FactorKind::exact).off < 1e-5);
}
