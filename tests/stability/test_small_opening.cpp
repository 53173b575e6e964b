// A room of reflectance 1 that emits, closed but for a slit: all light leaves by the slit, however
// small it is. There is a solution, brighter than the emission by the surface over the slit.
#include "radiosity/paper/solution/solve_error.h"
#include "support/catch.h"
#include "support/layered_model.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>
#include <optional>

using namespace hemilux;
using Catch::Contains;
using Model = test::LayeredModel;

namespace {

/// A unit cube whose sixth side leaves a slit of `share` of the whole surface.
Scene room_with_slit(double share) {
    const double width = 6 * share;
    Scene scene = test::box_room(Vec3(0.0), Vec3(1.0), 1, {{"glowing", Vec3(1.0), Vec3(1.0)}},
                                 {0, 0, 0, 0, 0, 0});
    scene.facets.erase(scene.facets.begin() + 3); // +x
    test::add_quad(scene, {1, 0, 0}, {1, 0, 1 - width}, {1, 1, 1 - width}, {1, 1, 0}, 1, 1, 0);
    return scene;
}

/// One run: its mean radiosity, or nothing where it says that the opening has not been seen.
std::optional<double> brightness(const Model& model, const Method& method, std::uint64_t seed,
                                 double rays, const StopRule& stop) {
    SolveOptions options;
    options.rays = rays;
    options.seed = seed;
    options.threads = 2;
    options.stop = stop;
    Solution solution;
    try {
        solution = test::solve(model, method, options, stop);
    } catch (const SolveError& error) {
        CHECK_THAT(error.what(), Contains("--rays") || Contains("--method stored-transport"));
        CHECK_THAT(error.what(), !Contains("nan"));
        return std::nullopt;
    }
    double power = 0, area = 0;
    for (std::size_t i = 0; i < solution.radiosity.size(); ++i) {
        power += model.mesh.patches()[i].area * solution.radiosity[i].x;
        area += model.mesh.patches()[i].area;
        CHECK(std::isfinite(solution.radiosity[i].x));
    }
    return power / area;
}

} // namespace

TEST_CASE("a glowing room of reflectance 1 is solved however small its opening is",
          "[slow][slit]") {
    const Method& stored = *find_method("stored-transport");
    for (const double share : {1e-2, 1e-3, 1.0 / 6000, 1e-4, 1e-5}) {
        const Model model(room_with_slit(share));
        for (const double rays : {1.0, 64.0})
            for (std::uint64_t seed = 1; seed <= 4; ++seed) {
                CAPTURE(share, rays, seed);
                const auto found = brightness(model, stored, seed, rays, test::steps(3));
                REQUIRE(found);
                // Of few rays; the solution is inversely proportional to what they count.
                CHECK(*found * share > .2);
                CHECK(*found * share < 5);
            }
    }
}

TEST_CASE("all methods end in a glowing room of reflectance 1 with a slit", "[slit]") {
    const Model model(room_with_slit(1e-3));
    for (const Method* const method : methods())
        for (std::uint64_t seed = 1; seed <= 2; ++seed) {
            CAPTURE(method->name, seed);
            const auto found = brightness(model, *method, seed, 4, test::steps(2));
            if (found)
                CHECK(*found > 0);
        }
}

TEST_CASE("an error is reached in a glowing room of reflectance 1 with a slit", "[slit][slow]") {
    for (const double share : {1.0 / 6000, 1e-5}) {
        const Model model(room_with_slit(share));
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            CAPTURE(share, seed);
            StopRule stop{.steps = {}, .seconds = {}, .error = .01};
            stop.rays = 10'000'000;
            const auto found = brightness(model, *find_method("stored-transport"), seed, 64, stop);
            REQUIRE(found);
            CHECK(*found * share == Approx(1).epsilon(.2));
        }
    }
}
