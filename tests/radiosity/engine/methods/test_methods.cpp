// Every method on scenes whose solution is known in closed form, patch by patch: a mean would not
// see a broken direction law. Scenes where a method is added inherit all of this.
#include "radiosity/engine/solving/method_option.h"
#include "radiosity/engine/solving/one_shot.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

using namespace hemilux;
using test::Model;

namespace {

/// The largest |B - B*| in standard errors over all patches; a patch without spread must be exact.
double worst_deviation(const Solution& solution, const Vec3& exact) {
    double worst = 0;
    for (std::size_t i = 0; i < solution.radiosity.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double difference = std::abs(solution.radiosity[i][c] - exact[c]);
            const double allowed = 1e-9 * exact[c] / 4; // what the linear solver leaves
            worst = std::max(worst, difference / (solution.standard_error[i][c] + allowed));
        }
    return worst;
}

SolveOptions with_seed(std::uint64_t seed, double rays = 64) {
    SolveOptions options;
    options.rays = rays;
    options.seed = seed;
    return options;
}

/// Enough for the tests below. `progressive` makes one pass, whose accuracy is what it calls rays.
Solution solve(const Model& model, const Method& method, SolveOptions options, std::uint32_t n) {
    if (method.name == "progressive") {
        options.rays *= 16;
        set_own_options(options, OneShotOptions{.one_shot = true});
        return test::solve(model, method, options, test::steps(1'000'000));
    }
    const std::uint32_t doublings = method.name == "matrix" ? 2 : 4;
    return test::solve(model, method, options,
                       test::steps(method.default_stop.error ? doublings : n));
}

} // namespace

// Four standard errors: some 1400 patch values in all; with 256 steps each lies outside by chance
// with probability 8e-5, so about one seed in ten would see one outside.
TEST_CASE("White furnace: every patch within 4 standard errors of E / (1 - rho)", "[slow]") {
    for (const Method* method : methods())
        for (const double rho : {.5, .8})
            for (const bool convex : {true, false}) {
                const Model model(convex ? test::furnace_box(3, rho) : test::furnace_l_shape(rho));
                const Solution s = solve(model, *method, with_seed(11, 32), 128);
                CAPTURE(method->name, rho, convex);
                CHECK(worst_deviation(s, Vec3(1 / (1 - rho))) < 4);
            }
}

TEST_CASE("The printed rules fail the furnace clearly", "[slow]") {
    const Model model(test::furnace_l_shape(.8));
    SolveOptions options = with_seed(11, 64);
    options.literal = true;
    for (const Method* method : methods())
        if (method->has_literal) {
            // hemisphere-1997 shoots by its own rules in the first three steps only.
            const std::uint32_t n = method->name == "hemisphere-1997" ? 3 : 32;
            const Solution s = test::solve(model, *method, options, test::steps(n));
            CAPTURE(method->name);
            CHECK(worst_deviation(s, Vec3(5)) > 6);
            CHECK(
                true_error(model.mesh, s.radiosity, std::vector<Vec3>(s.radiosity.size(), Vec3(5)))
                    .all > .05);
        }
}

TEST_CASE("A closed room keeps its energy, and colours do not mix", "[slow]") {
    // All walls reflect the same, one emits: sum A B = Phi / (1 - rho), in each channel.
    Scene scene = test::cube_with_lit_floor(3, .5);
    for (Material& m : scene.materials)
        m.reflectance = {.3, .5, .8};
    scene.materials[1].emission = {1, 2, 3};
    const Model model(scene);
    for (const Method* method : methods()) {
        const Solution s = solve(model, *method, with_seed(3, 256), 64);
        CAPTURE(method->name);
        Vec3 sum(0.0);
        for (std::size_t i = 0; i < s.radiosity.size(); ++i)
            sum += model.mesh.frame().area_to_world(model.mesh.patches()[i].area) * s.radiosity[i];
        CHECK(s.energy.emitted.x == Approx(1));
        CHECK(s.energy.emitted.y == Approx(2));
        CHECK(sum.x == Approx(1.4285714).epsilon(.003));
        CHECK(sum.y == Approx(4).epsilon(.003));
        CHECK(sum.z == Approx(15).epsilon(.01));
        for (int c = 0; c < 3; ++c) {
            CHECK(s.energy.absorbed[c] == Approx(s.energy.emitted[c]).epsilon(.01));
            CHECK(s.energy.escaped[c] == 0);
        }
    }
}

TEST_CASE("The lit cube's face means", "[slow]") {
    // The exact solution of the 96 equations, from the closed form of rectangles that face each
    // other.
    const Model model(test::cube_with_lit_floor(4, .5));
    for (const Method* method : methods()) {
        const Solution s = solve(model, *method, with_seed(5, 256), 100);
        CAPTURE(method->name);
        std::array<double, 6> mean{};
        for (std::size_t i = 0; i < 96; ++i)
            mean[i / 16] += s.radiosity[i].x / 16;
        CHECK(mean[0] == Approx(1.10264571).epsilon(.002));
        CHECK(mean[1] == Approx(.17182942).epsilon(.006));
        for (std::size_t wall = 2; wall < 6; ++wall)
            CHECK(mean[wall] == Approx(.18138122).epsilon(.006));
    }
}

TEST_CASE("A spherical cavity with an opening", "[slow]") {
    // B = E / (1 - rho (1 + cos phi) / 2); the polyhedron of triangles is not quite a sphere.
    constexpr double rho = .5;
    const auto cavity = [](int level) {
        Scene scene = test::sphere(level, 1, rho, 1);
        const double cos_phi = std::cos(std::numbers::pi / 6);
        std::erase_if(scene.facets, [&](const Facet& f) {
            const Vec3 centre = scene.vertices[f.vertex[0]] + scene.vertices[f.vertex[1]] +
                                scene.vertices[f.vertex[2]];
            return glm::normalize(centre).z > cos_phi;
        });
        return scene;
    };
    const Model fine(cavity(4)), coarse(cavity(3));
    for (const Method* method : methods()) {
        // What is shot to all patches in turn takes time as their square.
        const bool all_pairs = method->name == "progressive" || method->name == "hierarchical";
        const Model& model = all_pairs ? coarse : fine;
        const Solution s = solve(model, *method, with_seed(8, 32), 4);
        CAPTURE(method->name);
        double area = 0, sum = 0;
        for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
            area += model.mesh.patches()[i].area;
            sum += model.mesh.patches()[i].area * s.radiosity[i].x;
        }
        CHECK(sum / area == Approx(1.87443656).epsilon(.01));
        CHECK(s.energy.escaped.x > 0);
        CHECK(s.energy.escaped.x + s.energy.absorbed.x == Approx(s.energy.emitted.x).epsilon(.01));
    }
}

TEST_CASE("A large sphere inside out: backs absorb, two-sided sheets shine on both sides") {
    Scene scene;
    scene.materials = {{"lamp", Vec3(0.0), Vec3(1.0)}, {"sheet", Vec3(.5), Vec3(0.0)}};
    scene.groups = {"default"};
    // A lamp that shines up, at a sheet that looks up as well: its back is lit.
    test::add_quad(scene, {-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, 1, 1, 0);
    test::add_quad(scene, {-1, 1, -1}, {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, 1, 1, 1);
    for (const Method* method : methods()) {
        CAPTURE(method->name);
        const Model one(scene);
        const Solution s = solve(one, *method, with_seed(2, 2000), 16);
        CHECK(s.radiosity[1].x == 0);
        // F(2,1) of opposed squares: side 2, distance 1 (Howell C-11 with X = Y = 2).
        constexpr double factor = .41525;
        CHECK(s.energy.absorbed.x == Approx(4 * factor).epsilon(.01));
        const Model two(scene, {.two_sided = true});
        const Solution t = solve(two, *method, with_seed(2, 2000), 16);
        REQUIRE(t.radiosity.size() == 4);
        CHECK(t.radiosity[2].x == 0);                                // upper side of the sheet
        CHECK(t.radiosity[3].x == Approx(.5 * factor).epsilon(.01)); // lower side
    }
}

TEST_CASE("The same seed gives the same bytes for any number of threads", "[slow]") {
    const Model model(test::room_with_block());
    for (const Method* method : methods())
        for (const bool literal : {false, true}) {
            if (literal && !method->has_literal)
                continue;
            SolveOptions options = with_seed(77, 20);
            options.literal = literal;
            std::vector<Solution> s;
            for (const unsigned threads : {1u, 2u, 5u}) {
                options.threads = threads;
                s.push_back(test::solve(model, *method, options, test::steps(2)));
            }
            CAPTURE(method->name, literal);
            for (const std::size_t k : {1u, 2u}) {
                CHECK(s[k].radiosity == s[0].radiosity);
                CHECK(s[k].standard_error == s[0].standard_error);
                CHECK(s[k].hits == s[0].hits);
                CHECK(s[k].rays_energy == s[0].rays_energy);
                CHECK(s[k].energy.absorbed == s[0].energy.absorbed);
            }
            options.seed = 78;
            CHECK(test::solve(model, *method, options, test::steps(2)).radiosity != s[0].radiosity);
        }
}

TEST_CASE("A run ends at the steps, the time or the error asked for, or when interrupted") {
    const Model model(test::room_with_block());
    const Method& method = *find_method("stratified");
    CHECK(test::solve(model, method, with_seed(1), test::steps(3)).steps == 3);
    const Solution s =
        test::solve(model, method, with_seed(1), {.steps = 10000, .seconds = {}, .error = .05});
    CHECK(s.steps > 2);
    CHECK(s.steps < 10000);
    CHECK(estimated_error(model.mesh, s) <= .05);
    CHECK(test::solve(model, method, with_seed(1), {.steps = {}, .seconds = 1e-9, .error = {}})
              .steps == 1);

    Monitor monitor;
    const SolveOptions options = with_seed(1);
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    const auto solver = method.make(input);
    std::vector<Vec3> last;
    const bool completed =
        run(*solver, input, test::steps(10), [&](const StepRecord& record, const Solution& now) {
            last = now.radiosity;
            monitor.interrupted.set_wished(record.step == 4);
        });
    CHECK_FALSE(completed);
    CHECK(solver->solution().steps == 4);
    CHECK(solver->solution().radiosity == last);
}

TEST_CASE("A step shoots about the rays that were asked for") {
    for (const Scene& scene :
         {test::room_with_block(), test::open_scene(), test::furnace_box(4, .95)}) {
        const Model model(scene);
        for (const Method* method : methods()) {
            if (!method->unbiased)
                continue;
            const Solution s = test::solve(model, *method, with_seed(4, 100), test::steps(8));
            const double per_step = double(s.rays_energy) / 8 / double(model.mesh.patches().size());
            CAPTURE(method->name);
            CHECK(per_step == Approx(100).epsilon(.12));
        }
    }
}

TEST_CASE("Each role is one method's") {
    for (const Role role :
         {Role::standard, Role::reference, Role::baseline, Role::paper, Role::forerunner})
        CHECK(std::ranges::count(methods(), role, [](const Method* m) { return m->role; }) == 1);
}

namespace {

/// The texts that an option takes, with 8 for a number.
std::vector<std::string> values_of(const MethodOption& option) {
    if (option.values.empty())
        return {"no", "yes"};
    std::vector<std::string> values = option.values;
    for (std::string& value : values)
        std::ranges::replace(value, 'N', '8');
    return values;
}

} // namespace

TEST_CASE("Each option of a method is set by each of its values, and by no other text") {
    std::size_t values = 0;
    for (const Method* const method : methods())
        for (const MethodOption& option : method->own_options()) {
            CAPTURE(method->name, option.name);
            SolveOptions options;
            for (const char* const wrong : {"", "no such value", "-1", "4294967296"})
                CHECK_FALSE(option.set(options, wrong));
            CHECK_FALSE(option.is_set(options));
            for (const std::string& value : values_of(option)) {
                CHECK(option.set(options, value));
                CHECK(option.get(options).starts_with(value));
                ++values;
            }
        }
    CHECK(values > 30);
}

TEST_CASE("An option of a method is not in the way of another's") {
    for (const Method* const method : methods())
        for (const MethodOption& option : method->own_options()) {
            SolveOptions options;
            REQUIRE(option.set(options, values_of(option).back()));
            for (const Method* const other : methods())
                for (const MethodOption& another : other->own_options()) {
                    CAPTURE(option.name, another.name);
                    const bool same =
                        another.name == option.name || another.name == option.excludes;
                    CHECK(another.is_set(options) == same);
                }
        }
}

TEST_CASE("monte-carlo shot by shot: brighter with each, and in the end its first step") {
    const Model model(test::room_with_block());
    const Method& method = *find_method("monte-carlo");
    SolveOptions options = with_seed(5, 20);
    const Solution whole = test::solve(model, method, options, test::steps(1));
    set_own_options(options, OneShotOptions{.one_shot = true});
    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    const auto solver = method.make(input);
    const std::size_t patches = model.mesh.patches().size();
    std::vector<Vec3> before(patches, Vec3(0.0));
    double unshot_before = 2 * mean_of_channels(solver->solution().energy.emitted);
    std::uint32_t shots = 0;
    while (!solver->finished()) {
        REQUIRE(solver->step());
        const Solution& s = solver->solution();
        CHECK(s.steps == ++shots);
        for (std::size_t i = 0; i < patches; ++i)
            for (int c = 0; c < 3; ++c)
                if (!(s.radiosity[i][c] >= before[i][c] &&
                      s.radiosity[i][c] >= model.mesh.material(std::uint32_t(i)).emission[c]))
                    FAIL("patch " << i << " gets darker");
        before = s.radiosity;
        CHECK(std::isnan(s.standard_error[0].x));
        if (shots == 1) { // the brightest has shot
            const double unshot = mean_of_channels(s.energy.unshot);
            CHECK(unshot < unshot_before);
            CHECK(s.rays_energy < whole.rays_energy);
        }
    }
    CHECK(shots > patches / 2);
    const Solution& end = solver->solution();
    CHECK(test::same_bits(end.radiosity, whole.radiosity));
    CHECK(end.hits == whole.hits);
    CHECK(end.rays_energy == whole.rays_energy);
    CHECK(end.energy.absorbed == whole.energy.absorbed);
    CHECK(end.energy.unshot == whole.energy.unshot);
    REQUIRE(solver->step()); // there is nothing left
    CHECK(test::same_bits(solver->solution().radiosity, whole.radiosity));
    monitor.interrupted.set_wished(true);
    const auto other = method.make(input);
    CHECK_FALSE(other->step());
    CHECK(other->solution().steps == 0);
}
