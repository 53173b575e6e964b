// Patches that are divided further: nothing is lost, and rays find the pieces.
#include "radiosity/engine/cells/refine.h"
#include "radiosity/light/division/adaptive_division.h"
#include "radiosity/light/division/division_weights.h"
#include "radiosity/light/division/inherited.h"
#include "radiosity/light/division/patch_levels.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/scenes.h"
#include "support/solve.h"

#include "support/catch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace hemilux;
using test::Model;

namespace {

/// A skewed quad, a triangle about as wide as long, a narrow one, and a long quad; apart from each
/// other.
Scene some_shapes() {
    Scene scene;
    scene.materials = {{"grey", Vec3(.5), Vec3(1)}};
    scene.groups = {"default"};
    scene.vertices = {{0, 0, 0}, {1, 0, 0},    {.8, .6, 0}, {.1, 1, 0}, {2, 0, 0},
                      {3, 0, 0}, {2.4, .9, 0}, {4, 0, 0},   {6, 0, 0},  {6, .2, 0},
                      {0, 2, 0}, {4, 2, 0},    {4, 2.5, 0}, {0, 2.5, 0}};
    scene.facets = {{{0, 1, 2, 3}, 0, 0, 0},
                    {{4, 5, 6, 6}, 1, 0, 0},
                    {{7, 8, 9, 9}, 2, 0, 0},
                    {{10, 11, 12, 13}, 3, 0, 0}};
    scene.faces = 4;
    return scene;
}

double area_of(const Mesh& mesh) {
    double sum = 0;
    for (const Patch& patch : mesh.patches())
        sum += patch.area;
    return sum;
}

std::vector<std::uint8_t> random_levels(const Mesh& mesh, Rng& rng) {
    std::vector<std::uint8_t> levels(mesh.patches().size());
    for (std::uint8_t& level : levels)
        level = static_cast<std::uint8_t>(3 * rng.uniform());
    return levels;
}

/// How many rays towards random points of patches do not find their patch.
int rays_astray(const Model& model, Rng& rng) {
    int astray = 0;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i) {
        const Patch& patch = model.mesh.patches()[i];
        for (int k = 0; k < 4; ++k) {
            const Vec3 point = patch.shape.sample({rng.uniform(), rng.uniform()});
            const auto hit = model.bvh.closest({point + patch.normal, -patch.normal});
            astray += !hit || model.mesh.patch_at(*hit) != i;
        }
    }
    return astray;
}

} // namespace

TEST_CASE("refined patches cover their facets, and rays find each of them") {
    const bool two_sided = GENERATE(false, true);
    const double max_edge = GENERATE(0.0, .3);
    const int seed = GENERATE(1, 2, 3);
    Model model(some_shapes(), {.max_edge = max_edge, .two_sided = two_sided});
    const double area = area_of(model.mesh);
    Rng rng(static_cast<std::uint64_t>(seed));
    for (int round = 0; round < 3; ++round) {
        const std::size_t before = model.mesh.patches().size();
        refine(model.mesh, random_levels(model.mesh, rng));
        CAPTURE(two_sided, max_edge, seed, round);
        CHECK(model.mesh.patches().size() > before);
        CHECK(area_of(model.mesh) == Approx(area).epsilon(1e-10));
        CHECK(std::ranges::all_of(model.mesh.patches(),
                                  [](const Patch& patch) { return patch.area > 0; }));
        CHECK(rays_astray(model, rng) == 0);
    }
}

TEST_CASE("a level of refinement makes four of a patch, or two of a long one") {
    Model model(some_shapes());
    refine(model.mesh, std::vector<std::uint8_t>{1, 1, 1, 1});
    CHECK(model.mesh.patches().size() == 4 + 4 + 4 + 2);
    refine(model.mesh, std::vector<std::uint8_t>(14, 0));
    CHECK(model.mesh.patches().size() == 14);
}

TEST_CASE("pieces of a patch have what it had, and their sums over the area stay") {
    Model model(some_shapes(), {.two_sided = GENERATE(false, true)});
    Solution solution;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
        solution.radiosity.emplace_back(1 + i, 2, 3);
    solution.standard_error = solution.radiosity;
    solution.hits.resize(solution.radiosity.size());
    const auto power = [&] {
        double sum = 0;
        for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
            sum += model.mesh.patches()[i].area * solution.radiosity[i].x;
        return sum;
    };
    const double before = power();
    std::vector<Patch> patches(model.mesh.patches().begin(), model.mesh.patches().end());
    Rng rng(3);
    for (int round = 0; round < 2; ++round) {
        const auto parents = refine(model.mesh, random_levels(model.mesh, rng));
        REQUIRE(parents.size() == model.mesh.patches().size());
        for (std::uint32_t i = 0; i < parents.size(); ++i) {
            CHECK(model.mesh.patches()[i].facet == patches[parents[i]].facet);
            CHECK(model.mesh.patches()[i].back == patches[parents[i]].back);
        }
        inherit(solution, parents);
        CHECK(power() == Approx(before).epsilon(1e-10));
        patches.assign(model.mesh.patches().begin(), model.mesh.patches().end());
    }
}

TEST_CASE("the light of a furnace is the same on refined patches") {
    Model model(test::furnace_l_shape(.5));
    Rng rng(7);
    refine(model.mesh, random_levels(model.mesh, rng));
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {}, test::steps(2));
    for (const Vec3& radiosity : solution.radiosity)
        CHECK(radiosity.x == Approx(2).epsilon(1e-6));
}

TEST_CASE("patches are divided until what errs most errs little, and no further") {
    const std::vector<double> square{.01, 1e-4, -1e-3, 1e-6};
    const double sum = std::accumulate(square.begin(), square.end(), 0.0);
    using Levels = std::vector<std::uint8_t>;
    CHECK(levels_of_division(square, {.goal = sum, .min_pieces = 0, .max_pieces = 1000}) ==
          Levels{0, 0, 0, 0});
    CHECK(levels_of_division(square, {.goal = .5 * sum, .min_pieces = 0, .max_pieces = 1000}) ==
          Levels{1, 0, 0, 0});
    const Levels least =
        levels_of_division(square, {.goal = sum, .min_pieces = 8, .max_pieces = 1000});
    CHECK(least[0] > 0);
    CHECK(least[2] == 0);
    CHECK(levels_of_division(square, {.goal = 0, .min_pieces = 0, .max_pieces = 7}) ==
          Levels{1, 0, 0, 0});
    CHECK(levels_of_division({}, {.goal = 0, .min_pieces = 0, .max_pieces = 7}).empty());
}

TEST_CASE("one patch that errs much is not a reason to divide all others") {
    std::vector<double> square(100, 1e-6);
    square[7] = 1;
    const auto levels =
        levels_of_division(square, {.goal = .001, .min_pieces = 0, .max_pieces = 10'000});
    CHECK(levels[7] == 2);
    CHECK(std::ranges::count(levels, 0) == 99);
}

TEST_CASE("division goes where the light changes, and ends at the error asked for") {
    Model model(test::room_with_block());
    const std::size_t before = model.mesh.patches().size();
    Monitor monitor;
    const AdaptiveDivision twentieth{.error = .05};
    Solution solution = rough_solution(model.mesh, model.bvh, twentieth, monitor);
    std::vector<double> errors;
    Division division(model.mesh, model.bvh, twentieth, monitor);
    CHECK(division.divide(solution, twentieth.error,
                          [&](const DivisionRound& round) { errors.push_back(round.error); }));
    REQUIRE(errors.size() > 1);
    CHECK(errors.front() > .05);
    CHECK(errors.back() <= .05);
    const std::size_t patches = model.mesh.patches().size();
    CHECK(patches > before);
    CHECK(solution.radiosity.size() == patches);
    division.add_slopes(solution, twentieth.error);
    CHECK(solution.slope.size() == patches);
    // In doubt, and asked for less, it goes on from where it was.
    division.doubt();
    CHECK(division.divide(solution, .03));
    CHECK(model.mesh.patches().size() > patches);

    Model even(test::furnace_box(2, .5));
    const AdaptiveDivision hundredth{.error = .01};
    Solution furnace = rough_solution(even.mesh, even.bvh, hundredth, monitor);
    CHECK_FALSE(Division(even.mesh, even.bvh, hundredth, monitor).divide(furnace, .01));
    CHECK(even.mesh.patches().size() == 24);
}

TEST_CASE("many small patches that hardly vary are tried by a sample, large ones divided",
          "[slow]") {
    // A fine floor in a coarse room, below a ceiling that emits.
    Scene scene;
    scene.materials = {{"grey", Vec3(.5), Vec3(0)}, {"lamp", Vec3(0), Vec3(1)}};
    scene.groups = {"default"};
    constexpr std::uint32_t n = 200, patches = n * n + 5;
    test::add_quad(scene, {0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}, n, n, 0);
    test::add_quad(scene, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}, 1, 1, 1);
    test::add_quad(scene, {0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, 1, 1, 0);
    test::add_quad(scene, {1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}, 1, 1, 0);
    test::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, 0);
    test::add_quad(scene, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, 1, 1, 0);
    Monitor monitor;
    const AdaptiveDivision options{.error = .05};
    Model model(scene);
    Solution light = rough_solution(model.mesh, model.bvh, options, monitor);
    std::vector<std::uint64_t> rays;
    Division division(model.mesh, model.bvh, options, monitor);
    CHECK(division.divide(light, .05,
                          [&](const DivisionRound& round) { rays.push_back(round.rays); }));
    CHECK(model.mesh.patches().size() > patches);
    CHECK(model.mesh.patches().size() < patches + 1000);
    // Nine points or more, two gathers of six rays or more.
    const std::uint64_t rays_of_each = std::uint64_t{9} * 2 * 6 * patches;
    CHECK(rays.at(0) < rays_of_each * 3 / 4);
}

TEST_CASE("what varies on a patch counts for a target as the patch lights it from near") {
    const Model model(test::cube_with_lit_floor(1, .5));
    const auto patches = model.mesh.patches();
    std::vector<double> target(patches.size());
    target[0] = 2;
    const std::vector<double> counts =
        division_weights(model.mesh, model.bvh, target, 1, Workers(2));
    CHECK(counts == division_weights(model.mesh, model.bvh, target, 1, Workers(1)));
    CHECK(counts[0] == 2);
    constexpr double one_side = 2 * .5 * .5 * .2; // weight, reflectance squared, about the factor
    for (std::size_t i = 1; i < patches.size(); ++i) {
        const bool is_opposite = glm::dot(patches[i].normal, patches[0].normal) < -.5;
        CAPTURE(i, is_opposite);
        CHECK(counts[i] < (is_opposite ? .9 : 1.02) * one_side);
        CHECK(counts[i] > (is_opposite ? .5 : .8) * one_side);
    }
}
