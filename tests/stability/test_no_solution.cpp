// Scenes that have no solution, or none in doubles: said with patch and step instead of an endless
// run or an infinite number; and scenes of reflectance 1 that do have one.
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/paper/solving/lossless_component.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

using namespace hemilux;
using Catch::Contains;
using test::Model;

namespace {

SolveOptions few_rays(double rays = 32) {
    SolveOptions options;
    options.rays = rays;
    options.threads = 2;
    return options;
}

/// What every method says of it.
void check_refused(const Scene& scene, const std::vector<std::string>& words) {
    const Model model(scene);
    for (const Method* const method : methods()) {
        if (method->strategy && method->name != "hemisphere")
            continue; // the same solver
        CAPTURE(method->name);
        std::string message;
        try {
            (void)test::solve(model, *method, few_rays(), test::steps(1));
        } catch (const SolveError& error) {
            message = error.what();
        }
        for (const std::string& word : words)
            CHECK_THAT(message, Contains(word));
    }
}

Scene without_facet(Scene scene, std::size_t facet) {
    scene.facets.erase(scene.facets.begin() + static_cast<std::ptrdiff_t>(facet));
    return scene;
}

/// A closed box within another, which has the lamps of its own.
Scene box_in_a_room(const Material& inner, const Material& outer) {
    Scene scene = test::box_room(Vec3(0.0), Vec3(4.0), 2, {outer, inner}, {0, 0, 0, 0, 0, 0});
    const Scene box = test::box_room(Vec3(1.0), Vec3(2.0), 1, {inner}, {0, 0, 0, 0, 0, 0});
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), box.vertices.begin(), box.vertices.end());
    scene.groups.push_back("box");
    for (Facet facet : box.facets) {
        for (std::uint32_t& v : facet.vertex)
            v += first;
        facet.face = scene.faces++;
        facet.material = facet.group = 1;
        scene.facets.push_back(facet);
    }
    return scene;
}

std::optional<LosslessComponent> lossless_component(const Model& model) {
    Monitor monitor;
    const SolveOptions options = few_rays();
    return find_lossless_component({model.mesh, model.bvh, options, monitor}, 3e5);
}

double total(const Vec3& v) { return v.x + v.y + v.z; }

} // namespace

TEST_CASE("Numbers that are none are refused by all methods, with patch, face and material") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {nan, -.1, 1.0000001, double(INFINITY)}) {
        Scene scene = test::room_with_block();
        scene.materials[1].reflectance.y = bad;
        check_refused(scene, {"reflectance", "'red'", "patch", "face"});
    }
    for (const double bad : {nan, -1.0, double(INFINITY), 1e308}) {
        Scene scene = test::room_with_block();
        scene.materials[3].emission.z = bad;
        check_refused(scene, {"emission", "'lamp'"});
    }
}

TEST_CASE("A channel too faint for squares is refused, and one at the limit is solved") {
    Scene scene = test::room_with_block();
    scene.materials[3].emission = Vec3(1, 1e-150, 0);
    check_refused(scene, {"the emission of patch", "'lamp'", "largest of its channel"});
    const double limit = std::ldexp(1, -480); // a power of two: the same digits
    REQUIRE(limit > min_radiosity);
    REQUIRE(limit / 8 < min_radiosity);
    const Model bright(test::cube_with_lit_floor(2, .5));
    Scene faint_scene = test::cube_with_lit_floor(2, .5);
    faint_scene.materials[1].emission *= limit;
    const Model faint(faint_scene);
    for (const Method* const method : methods()) {
        const Solution a = test::solve(bright, *method, few_rays(), test::steps(2));
        const Solution b = test::solve(faint, *method, few_rays(), test::steps(2));
        CAPTURE(method->name);
        for (std::size_t i = 0; i < a.radiosity.size(); ++i)
            CHECK(b.radiosity[i].x / limit == Approx(a.radiosity[i].x).epsilon(1e-6));
        CHECK(estimated_error(faint.mesh, b) ==
              Approx(estimated_error(bright.mesh, a)).epsilon(1e-3));
    }
}

TEST_CASE("Powers that overflow are found before the first step") {
    Scene scene = test::furnace_box(1, .5, 1e100);
    for (Vec3& v : scene.vertices)
        v *= 1e60; // areas of 1e120
    check_refused(scene, {"before the first step: the emitted power", "'wall'"});
}

TEST_CASE("A step that overflows leaves the solution of the steps before") {
    // Its expectation is right below the largest number, so that chance decides when it is passed.
    const Model model(test::furnace_box(3, .5, largest_radiosity / 2 / 1.13));
    for (const char* const name : {"hemisphere", "monte-carlo"}) {
        SolveOptions options = few_rays(200);
        Monitor monitor;
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        const auto solver = find_method(name)->make(input);
        std::uint32_t done = 0;
        std::string message;
        try {
            run(*solver, input, test::steps(1000),
                [&](const StepRecord& record, const Solution&) { done = record.step; });
        } catch (const SolveError& error) {
            message = error.what();
        }
        CAPTURE(name, message);
        CHECK_THAT(message, Contains("step " + std::to_string(done + 1) + ": the ") &&
                                Contains("patch ") && Contains("'wall'"));
        CHECK(done > 0);
        const Solution& s = solver->solution();
        CHECK(s.steps == done);
        CHECK(std::ranges::all_of(s.radiosity, [](const Vec3& b) {
            return total(b) > 0 && total(b) < 3 * largest_radiosity;
        }));
        CHECK(std::isfinite(s.energy.imbalance()));
    }
}

TEST_CASE("A closed room of reflectance 1 has no solution: it is named", "[slow]") {
    check_refused(test::furnace_box(1, 1),
                  {"no finite solution: 6 patches", "'wall'", "'default'", "(face 0", "rays"});
    for (const Scene& scene : {test::furnace_l_shape(1), test::sphere(1, 3, 1, 1)}) {
        const Model model(scene);
        const auto component = lossless_component(model);
        REQUIRE(component);
        CHECK(component->patches.size() == scene.facets.size());
        CHECK(component->channel == 0);
    }
}

TEST_CASE("Only the part that is closed is named, and only in its channel", "[slow]") {
    Scene scene =
        box_in_a_room({"white", Vec3(.5, 1, .5), Vec3(1.0)}, {"grey", Vec3(.5), Vec3(1.0)});
    const Model enclosed(scene);
    CHECK_THROWS_WITH(test::solve(enclosed, *find_method("matrix"), few_rays(), test::steps(1)),
                      Contains("6 patches") && Contains("(green)") && Contains("'box'") &&
                          Contains("'white'") && Contains("(face 24"));
    scene.materials[1].emission.y = 0; // nothing is trapped there
    const Model model(scene);
    for (const Method* const method : methods()) {
        const Solution s = test::solve(model, *method, few_rays(), test::steps(2));
        CAPTURE(method->name);
        CHECK(s.energy.imbalance() < 1e-10);
        for (std::uint32_t i = 24; i < 30; ++i)
            CHECK(s.radiosity[i].y == 0);
    }
}

TEST_CASE("Rooms of reflectance 1 with a way out are solved") {
    Scene open = without_facet(test::cube_with_lit_floor(3, 1), 13); // a ninth of the ceiling
    Scene black = test::cube_with_lit_floor(3, 1);
    black.materials.push_back({"black", Vec3(0.0), Vec3(0.0)});
    black.facets[13].material = 2;
    for (const bool is_open : {true, false}) {
        const Model model(is_open ? open : black);
        for (const Method* const method : methods()) {
            SolveOptions options = few_rays(32);
            const StopRule stop = method->default_stop.error
                                      ? StopRule{.steps = 50, .seconds = {}, .error = .1}
                                      : test::steps(4);
            const Solution s = test::solve(model, *method, options, stop);
            CAPTURE(method->name, is_open, s.energy.unshot.x, s.energy.absorbed.x);
            CHECK(s.energy.imbalance() < 1e-10);
            const double out = is_open ? s.energy.escaped.x : s.energy.absorbed.x;
            CHECK(out + s.energy.unshot.x == Approx(1));
            if (method->name != "progressive")           // which stops early
                CHECK(std::abs(s.energy.unshot.x) < .5); // a ray may carry some per cent
            CHECK((is_open ? s.energy.absorbed.x : s.energy.escaped.x) == 0);
            if (method->name == "stored-transport") { // the first step's error is unknown
                CHECK(estimated_error(model.mesh, s) < .1);
                CHECK(s.rays_energy < 1000000);
            }
        }
    }
}

TEST_CASE("Under the open sky reflectance 1 is as good as any other", "[slow]") {
    Scene scene = test::open_scene();
    for (Material& material : scene.materials)
        material.reflectance = Vec3(1, 1, .3);
    const Model model(scene);
    const Solution matrix = test::reference(model, .02);
    for (const Method* const method : methods()) {
        const bool steps = !method->default_stop.error || method->name == "progressive";
        const StopRule stop =
            steps ? test::steps(8) : StopRule{.steps = {}, .seconds = {}, .error = .03};
        const Solution s = test::solve(model, *method, few_rays(256), stop);
        const double off = true_error(model.mesh, s.radiosity, matrix.radiosity).all;
        CAPTURE(method->name, off);
        CHECK(off < .12);
        CHECK(s.energy.absorbed.x == Approx(0).margin(1e-12 + s.energy.emitted.x)); // backs
        CHECK(s.energy.imbalance() < 1e-10);
    }
}

TEST_CASE("A lamp that few rays would find is a way out") {
    Scene scene = test::box_room(Vec3(0.0), Vec3(1.0), 2, {{"wall", Vec3(1.0), Vec3(0.0)}},
                                 {0, 0, 0, 0, 0, 0});
    scene.materials.push_back({"lamp", Vec3(.5), Vec3(1.0)});
    test::add_quad(scene, {.5, .99, .5}, {.501, .99, .5}, {.501, .99, .501}, {.5, .99, .501}, 1, 1,
                   1);
    const Model lit(scene);
    CHECK_FALSE(lossless_component(lit));
    scene.materials[1].reflectance = Vec3(1.0);
    const Model closed(scene);
    const auto component = lossless_component(closed);
    REQUIRE(component);
    CHECK(component->patches.size() == 24 + 1);
    CHECK(component->rays >= 300'000);
}

TEST_CASE("A series of bounces that seems not to end is ended", "[slow]") {
    const Model model(test::furnace_box(1, 1 - 1e-12));
    SolveOptions options;
    options.rays = 4;
    CHECK_THROWS_WITH(
        test::solve(model, *find_method("progressive-monte-carlo"), options, test::steps(1)),
        Contains("step 1: light is still on its way") && Contains("stored-transport"));
    const Solution s =
        test::solve(model, *find_method("stored-transport"), options, test::steps(1)); // needs none
    CHECK(s.radiosity[0].x == Approx(1 / 1e-12).epsilon(1e-3));
}
