// Shooting methods with a target: importance against that of stored rays, light against `matrix` on
// the target and elsewhere, and what the target saves.
#include "radiosity/engine/form_factors/exchange_matrix.h"
#include "radiosity/engine/form_factors/ray_counts.h"
#include "radiosity/engine/linear/surfaces.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/shooting/stepwise.h"
#include "radiosity/engine/stored_transport/importance.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/alike_neighbours.h"
#include "radiosity/research/targets/aimed_rays.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/targets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

using namespace hemilux;
using test::first_room;
using test::Model;
using test::solve_for;
using test::two_rooms;

namespace {

/// All methods that shoot from what holds power.
std::vector<const Method*> shooting_methods() {
    std::vector<const Method*> result;
    for (const Method* const method : methods())
        if (method->takes_target() && (method->strategy || method->name == "monte-carlo"))
            result.push_back(method);
    return result;
}

SolveOptions options_of(std::uint64_t seed, double rays = 64, unsigned threads = 1) {
    SolveOptions options;
    options.rays = rays;
    options.seed = seed;
    options.threads = threads;
    return options;
}

/// Of the patches to `end`, 1.
std::vector<double> first_patches(const Mesh& mesh, std::size_t end) {
    std::vector<double> weight(mesh.patches().size());
    std::fill_n(weight.begin(), end, 1.0);
    return weight;
}

/// What patches get, found by as many rays.
Aim aim_of(const Model& model, std::span<const double> target, double rays, bool balls = false) {
    Monitor monitor;
    const SolveOptions options = options_of(3);
    const SolverInput input{model.mesh, model.bvh, options, monitor, everything_needed, target};
    StepResult pilot(model.mesh);
    const double ray_power = mean_of_channels(emitted_power(model.mesh)) / rays;
    return aim_rays(input, {7, 1, ray_power, Workers(2)}, balls, pilot);
}

/// A room, and on its floor a small thing that is the target. Large patches stand near it.
struct SmallTarget {
    Model model;
    std::vector<double> weight;
};

SmallTarget small_target() {
    Scene scene = test::room_with_block();
    const std::size_t before = scene.facets.size();
    test::add_cube(scene, {.7, .3, .06}, .05);
    SmallTarget result{Model(scene), {}};
    for (const Patch& patch : result.model.mesh.patches())
        result.weight.push_back(patch.facet >= before ? 1 : 0);
    return result;
}

/// sqrt(J) by patch, J = F rho (u + J) being found on stored rays, the mean over neighbours.
std::vector<double> root_of_importance(const Model& model, std::span<const double> target) {
    Monitor monitor;
    const std::vector<std::uint32_t> each(target.size(), 4096);
    RayCounts rays(model.mesh, model.bvh, 5);
    rays.trace_up_to(each, Workers(2), monitor);
    const Surfaces at(model.mesh);
    std::vector<double> source;
    for (std::uint32_t i = 0; i < target.size(); ++i)
        source.push_back(target[i] * mean_of_channels(at.reflectance[i]) / at.area[i]);
    const std::vector<Vec3> importance = importance_of(ExchangeMatrix(at.area, rays), at.area,
                                                       at.reflectance, source, Workers(2), 1e-9);
    std::vector<double> roots;
    for (std::uint32_t i = 0; i < target.size(); ++i) {
        double sum = 0, count = 0;
        const auto add = [&](std::uint32_t j) {
            sum += mean_of_channels(importance[j]) - source[j];
            ++count;
        };
        add(i);
        for_alike_neighbours(model.mesh, i, add);
        roots.push_back(std::sqrt(sum / count));
    }
    return roots;
}

/// How far runs of different seeds are off, over their reported standard errors: patches and
/// channels that 30 rays a run have hit.
struct Scores {
    double of_runs; ///< RMS of single runs
    double of_mean; ///< RMS of the mean of all runs, which tells bias from chance
};

Scores scores(const Model& model, std::span<const Solution> runs, const Solution& exact,
              const std::vector<bool>& counts) {
    double single = 0, mean = 0, pairs = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const auto seldom = [&](const Solution& s) { return s.hits[i] < 30; };
        if (!counts[i] || std::ranges::any_of(runs, seldom) ||
            model.mesh.material(std::uint32_t(i)).reflectance == Vec3(0.0))
            continue;
        for (int c = 0; c < 3; ++c) {
            double sum = 0, squares = 0, variance = 0;
            const double exact_sigma = exact.standard_error[i][c];
            for (const Solution& s : runs) {
                const double off = s.radiosity[i][c] - exact.radiosity[i][c];
                sum += off;
                squares += off * off;
                variance += s.standard_error[i][c] * s.standard_error[i][c];
            }
            const auto n = static_cast<double>(runs.size());
            single += squares / (variance + n * exact_sigma * exact_sigma);
            mean += sum * sum / (variance + n * n * exact_sigma * exact_sigma);
            ++pairs;
        }
    }
    return {std::sqrt(single / pairs), std::sqrt(mean / pairs)};
}

/// As root mean squares and sums over the runs.
struct Runs {
    double error = 0, rays = 0, reported_over_true = 0;
};

Runs runs_for(const Model& model, const Method& method, std::span<const double> target,
              std::span<const double> counted, const Solution& exact, int seeds, double rays = 64) {
    Runs result;
    for (int seed = 1; seed <= seeds; ++seed) {
        const Solution s = solve_for(model, method, target,
                                     options_of(std::uint64_t(seed), rays, 0), test::steps(4));
        const double off = test::true_error_of(model.mesh, s, exact, counted);
        result.error += off * off / seeds;
        result.rays += double(s.rays_energy);
        result.reported_over_true += std::log(estimated_error(model.mesh, s) / off) / seeds;
    }
    result.error = std::sqrt(result.error);
    result.reported_over_true = std::exp(result.reported_over_true);
    return result;
}

/// How many times as many rays the runs without a target take for the same error.
double gain(const Runs& without, const Runs& with) {
    return without.error * without.error * without.rays / (with.error * with.error * with.rays);
}

} // namespace

TEST_CASE("Rays are as the root of the importance that stored rays tell") {
    const Model model(test::room_with_block());
    const std::vector<double> target = first_patches(model.mesh, 16);
    const std::vector<double> times = aim_of(model, target, 4e5).times;
    const std::vector<double> roots = root_of_importance(model, target);
    double ratio = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
        ratio += times[i] / roots[i] / double(times.size());
    double square = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
        square += std::pow(times[i] / (ratio * roots[i]) - 1, 2) / double(times.size());
    CHECK(std::sqrt(square) < .1);
    CHECK(*std::ranges::max_element(roots) > 2 * *std::ranges::min_element(roots));
}

TEST_CASE("Each patch keeps some rays, those that light cannot leave for the target the fewest") {
    const Model model(two_rooms());
    const std::vector<double> target = first_room(model.mesh);
    const std::vector<double> times = aim_of(model, target, 1e5).times;
    const std::size_t half = target.size() / 2;
    const double least = *std::min_element(times.begin(), times.begin() + std::ptrdiff_t(half));
    for (std::size_t i = half; i < times.size(); ++i) {
        CHECK(times[i] > 0);
        CHECK(times[i] < .2 * least);
    }
}

TEST_CASE("Where no light is seen to reach the target rays are as without") {
    Scene scene = two_rooms();
    scene.materials[1].emission = Vec3(0.0); // the lamp of the target's room
    const Model model(scene);
    for (const double times : aim_of(model, first_room(model.mesh), 1e4).times)
        CHECK(times == 1);
}

TEST_CASE("A small target gets a ball, a large one none") {
    const auto [model, target] = small_target();
    const Aim aim = aim_of(model, target, 1e5, true);
    REQUIRE(aim.balls.count() > 0);
    double power = 0, rays = 0;
    for (std::uint32_t i = 0; i < target.size(); ++i) {
        const double of_patch = model.mesh.patches()[i].area; // where all shine alike
        power += of_patch;
        rays += of_patch * aim.times[i];
        for (std::size_t k = 0; k < aim.balls.count(); ++k)
            rays += of_patch * aim.balls.times(i, k);
    }
    CHECK(rays < 2 * power);
    CHECK(rays > .5 * power);
    const std::vector<double> all(target.size(), 1.0);
    CHECK(aim_of(model, all, 1e5, true).balls.count() == 0);
}

void check_light(const Model& model, std::span<const double> target,
                 std::span<const Method* const> methods, std::uint32_t steps) {
    const Solution exact = test::reference(model, .001);
    std::vector<bool> on_target, elsewhere;
    for (const double weight : target) {
        on_target.push_back(weight > 0);
        elsewhere.push_back(!(weight > 0));
    }
    for (const Method* const method : methods) {
        std::vector<Solution> runs;
        for (std::uint64_t seed = 1; seed <= 8; ++seed)
            runs.push_back(solve_for(model, *method, target, options_of(seed), test::steps(steps)));
        for (const auto& part : {on_target, elsewhere}) {
            const Scores score = scores(model, runs, exact, part);
            CAPTURE(method->name, score.of_runs, score.of_mean);
            CHECK(score.of_runs > .75); // the error of the level is reported larger than it shows
            CHECK(score.of_runs < 1.1);
            CHECK(score.of_mean < 1.3);
        }
    }
}

TEST_CASE("With a target light is that of matrix, on it and elsewhere, within the errors",
          "[slow]") {
    const Model model(test::room_with_block());
    check_light(model, first_patches(model.mesh, 16), shooting_methods(), 8);
}

TEST_CASE("With rays to balls light is that of matrix, on the target and elsewhere", "[slow]") {
    const auto [model, target] = small_target();
    std::vector<const Method*> methods = shooting_methods();
    std::erase_if(methods, [](const Method* method) { return !method->strategy; });
    check_light(model, target, methods, 24); // its patches have no neighbours to share a spread
}

void check_repeats(const Model& model, const std::vector<double>& target) {
    for (const Method* const method : shooting_methods()) {
        CAPTURE(method->name);
        const Solution one =
            solve_for(model, *method, target, options_of(1, 24, 1), test::steps(4));
        const SolveOptions options = options_of(1, 24, 2);
        const Solution two = solve_for(model, *method, target, options, test::steps(4));
        CHECK(test::same_bits(one.radiosity, two.radiosity));
        CHECK(test::same_bits(one.standard_error, two.standard_error));
        CHECK(one.rays_energy == two.rays_energy);

        Monitor monitor;
        const SolverInput input{model.mesh, model.bvh, options, monitor, everything_needed, target};
        const auto first = method->make(input), second = method->make(input);
        first->step();
        first->step();
        const std::string state = test::hand_over(*first, *second);
        second->step();
        second->step();
        CHECK(test::same_bits(one.radiosity, second->solution().radiosity));
        CHECK(test::same_bits(one.standard_error, second->solution().standard_error));

        std::vector<double> other = target;
        other[0] = .5;
        const SolverInput changed{model.mesh, model.bvh,         options,
                                  monitor,    everything_needed, other};
        StateReader again(state);
        CHECK_THROWS_AS(method->make(changed)->load(again), StateError);
    }
}

TEST_CASE("With a target shooting does not depend on threads, nor on an interruption") {
    const Model model(test::room_with_block());
    check_repeats(model, first_patches(model.mesh, 8));
    const auto [small, target] = small_target();
    check_repeats(small, target);
}

TEST_CASE("Things on a table take a fifth of the rays", "[slow]") {
    for (const char* scene : {"room_1002", "office_3576"}) {
        const Model model = test::example(scene);
        const std::vector<double> target = test::weights_of(model.mesh, "detail");
        SolveOptions exactly = options_of(99, 64, 0);
        exactly.stop.error = .002;
        const Solution exact = solve_for(model, *find_method("stored-transport"), target, exactly,
                                         {.steps = {}, .seconds = {}, .error = .002});
        for (const char* name : {"hemisphere", "progressive-monte-carlo"}) {
            const Method& method = *find_method(name);
            const Runs without = runs_for(model, method, {}, target, exact, 10, 256);
            const Runs with = runs_for(model, method, target, target, exact, 10, 256);
            CAPTURE(scene, name, without.error, with.error, gain(without, with),
                    with.reported_over_true);
            CHECK(gain(without, with) > 5);
            CHECK(with.reported_over_true > .8);
            CHECK(with.reported_over_true < 1.25);
        }
    }
}

TEST_CASE("One room of a building takes a third of the rays", "[slow]") {
    const Model model = test::example("building_6");
    const std::vector<double> target = test::weights_of(model.mesh, "room_1");
    SolveOptions exactly = options_of(99, 64, 0);
    exactly.stop.error = .001;
    const Solution exact = solve_for(model, *find_method("stored-transport"), target, exactly,
                                     {.steps = {}, .seconds = {}, .error = .001});
    for (const char* name : {"hemisphere", "progressive-monte-carlo"}) {
        const Method& method = *find_method(name);
        const Runs without = runs_for(model, method, {}, target, exact, 10);
        const Runs with = runs_for(model, method, target, target, exact, 10);
        CAPTURE(name, without.error, with.error, gain(without, with), with.reported_over_true);
        CHECK(gain(without, with) > 3);
        CHECK(with.reported_over_true > .8);
        CHECK(with.reported_over_true < 1.25);
    }
}

TEST_CASE("Shooting for a target that is all of the scene loses nothing", "[slow]") {
    for (const char* scene : {"room_1002", "office_3576"}) {
        const Model model = test::example(scene);
        const std::vector<double> all(model.mesh.patches().size(), 1.0);
        SolveOptions exactly = options_of(99, 64, 0);
        exactly.stop.error = .002;
        const Solution exact = solve_for(model, *find_method("stored-transport"), {}, exactly,
                                         {.steps = {}, .seconds = {}, .error = .002});
        for (const char* name : {"stratified", "hemisphere", "progressive-monte-carlo"}) {
            const Method& method = *find_method(name);
            const Runs without = runs_for(model, method, {}, all, exact, 4);
            const Runs with = runs_for(model, method, all, all, exact, 4);
            CAPTURE(scene, name, gain(without, with));
            CHECK(gain(without, with) > .95);
        }
    }
}
