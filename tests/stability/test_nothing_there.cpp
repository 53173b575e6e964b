// Scenes and options with next to nothing in them: every method ends, and nothing is NaN.

#include "radiosity/engine/needs/find_needs.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>
#include <stdexcept>

using namespace hemilux;
using hemilux::test::Model;

namespace {

/// Triangles of one material each: corners, reflectance, emission.
struct Leaf {
    std::array<Vec3, 3> corner;
    double reflectance, emission;
};

Scene leaves(const std::vector<Leaf>& list) {
    Scene scene;
    scene.groups = {"default"};
    for (const Leaf& leaf : list) {
        const auto n = static_cast<std::uint32_t>(scene.vertices.size());
        const auto m = static_cast<std::uint32_t>(scene.materials.size());
        scene.vertices.insert(scene.vertices.end(), leaf.corner.begin(), leaf.corner.end());
        scene.materials.push_back({"m", Vec3(leaf.reflectance), Vec3(leaf.emission)});
        scene.facets.push_back({{n, n + 1, n + 2, n + 2}, m, m, 0});
        ++scene.faces;
    }
    return scene;
}

constexpr std::array<Vec3, 3> up{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
constexpr std::array<Vec3, 3> down_below{Vec3(0, 0, -1), Vec3(0, 1, -1), Vec3(1, 0, -1)};
constexpr std::array<Vec3, 3> down_above{Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 0, 1)};

SolveOptions asked(double rays, int depth = 2, double threshold = 0) {
    SolveOptions options;
    options.rays = rays;
    options.depth = depth;
    options.threshold = threshold;
    return options;
}

bool finite(const Vec3& v) { return std::isfinite(v.x + v.y + v.z); }

/// Solves by a method, with and without what the scene does not need.
Solution solved(const Model& model, const Method& method, SolveOptions options,
                const StopRule& stop) {
    options.literal = options.literal && method.has_literal;
    Monitor monitor;
    const Needs needs = options.keep_all ? everything_needed : find_needs(model.mesh);
    const SolverInput input{model.mesh, model.bvh, options, monitor, needs};
    const auto solver = method.make(input);
    CHECK(run(*solver, input, stop));
    return solver->solution();
}

void check_sound(const Model& model, const Solution& solution) {
    bool sound = true;
    double largest = 0;
    for (std::uint32_t i = 0; i < solution.radiosity.size(); ++i) {
        const Vec3& b = solution.radiosity[i];
        sound = sound && finite(b) && b.x >= -1e-9 && b.y >= -1e-9 && b.z >= -1e-9;
        if (solution.steps > 1)
            sound = sound && finite(solution.standard_error[i]);
        largest = std::max(largest, b.x - model.mesh.material(i).emission.x);
    }
    CHECK(sound);
    CHECK(std::isfinite(largest));
    CHECK(solution.steps > 0);
    for (const Vec3& power :
         {solution.energy.emitted, solution.energy.absorbed, solution.energy.escaped})
        CHECK(finite(power));
    CHECK_FALSE(std::isinf(estimated_error(model.mesh, solution)));
}

template <class Check>
void by_all_methods(const Scene& scene, SolveOptions options, Check check) {
    const Model model(scene);
    options.threads = 2;
    for (const Method* const method : methods())
        for (const bool keep_all : {false, true})
            for (const bool literal : {false, true}) {
                if (literal && !method->has_literal)
                    continue;
                CAPTURE(method->name, keep_all, literal);
                options.keep_all = keep_all;
                options.literal = literal;
                const Solution solution = solved(model, *method, options, test::steps(3));
                check_sound(model, solution);
                check(model, solution);
            }
}

void check_emission_alone(const Model& model, const Solution& solution) {
    for (std::uint32_t i = 0; i < solution.radiosity.size(); ++i)
        CHECK(solution.radiosity[i] == model.mesh.material(i).emission);
}

void nothing_more(const Model&, const Solution&) {}

} // namespace

TEST_CASE("an empty scene is refused") {
    CHECK_THROWS_AS(Mesh(Scene{}), std::invalid_argument);
    Scene vertices;
    vertices.vertices = {{0, 0, 0}, {1, 0, 0}};
    CHECK_THROWS_AS(Mesh(vertices), std::invalid_argument);
}

TEST_CASE("one patch sees nothing and keeps its emission") {
    by_all_methods(leaves({{up, .5, 1}}), asked(50), check_emission_alone);
    by_all_methods(leaves({{up, 0, 1}}), asked(50), check_emission_alone);
}

TEST_CASE("where nothing emits all is dark") {
    by_all_methods(test::furnace_box(2, .5, 0), asked(20), check_emission_alone);
    by_all_methods(leaves({{up, .5, 0}}), asked(20), check_emission_alone);
    by_all_methods(leaves({{up, 0, 0}, {down_above, 0, 0}}), asked(20), check_emission_alone);
}

TEST_CASE("where there are only black emitters each keeps its emission") {
    by_all_methods(test::furnace_box(2, 0, 3), asked(20), check_emission_alone);
    by_all_methods(leaves({{up, 0, 1}, {down_above, 0, 2}}), asked(20), check_emission_alone);
}

TEST_CASE("patches that turn their backs see nothing: no density anywhere") {
    by_all_methods(leaves({{up, .5, 1}, {down_below, .9, 2}}), asked(30), check_emission_alone);
}

TEST_CASE("a patch that sees nothing beside some that see each other") {
    Scene scene = leaves({{up, .5, 1}, {down_above, .5, 0}, {down_below, .5, 0}});
    by_all_methods(scene, asked(100), [](const Model&, const Solution& solution) {
        CHECK(solution.radiosity[2] == Vec3(0.0));
        CHECK(solution.radiosity[1].x > 0);
    });
}

TEST_CASE("fewer rays than triangles, and hardly any at all", "[slow]") {
    const double rays = GENERATE(1.0, 1.0 / 24, 1e-6, 3.0);
    CAPTURE(rays);
    by_all_methods(test::furnace_box(2, .5), asked(rays), nothing_more);
    by_all_methods(leaves({{up, .5, 1}, {down_above, .5, 0}}), asked(rays, 3), nothing_more);
}

TEST_CASE("every depth, and thresholds that divide all or nothing", "[slow]") {
    const int depth = GENERATE(0, 1, 5);
    const double threshold = GENERATE(0.0, 1e300);
    CAPTURE(depth, threshold);
    by_all_methods(test::furnace_box(1, .5), asked(40, depth, threshold), nothing_more);
    by_all_methods(leaves({{up, .5, 1}, {down_above, .5, 0}}), asked(40, depth, threshold),
                   nothing_more);
}

TEST_CASE("a million rays per patch", "[slow]") {
    by_all_methods(leaves({{up, .5, 1}, {down_above, .5, 0}}), asked(1e6), nothing_more);
}
