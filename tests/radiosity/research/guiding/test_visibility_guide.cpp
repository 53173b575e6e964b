// The hemisphere guided by what is seen: unbiased, honest, and the same for any number of threads.
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/research/guiding/ray_densities.h"
#include "radiosity/research/guiding/visibility_guide.h"

#include "parallel/workers.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/shooting/shooting.h"
#include "radiosity/engine/shooting/step_hook.h"
#include "radiosity/engine/shooting/strategy.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "support/catch.h"
#include "support/guides.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace hemilux;
using test::Model;

namespace {

constexpr std::array<const char*, 2> guides{"visible", "learned"};

SolveOptions guided(const char* guide, std::uint64_t seed = 3) {
    SolveOptions options;
    set_own_options(options, GuideChoice{.guide = test::guide_named(guide)});
    options.seed = seed;
    return options;
}

const Method& hemisphere_method() { return *find_method("hemisphere"); }

/// A strategy that knows a radiosity, as before the first step.
struct Guided {
    SolveOptions options;
    Monitor monitor;
    Hemisphere hemisphere;
    std::unique_ptr<Strategy> strategy;

    Guided(const Model& model, const SolveOptions& wanted, const std::vector<Vec3>& radiosity)
        : options(wanted), hemisphere(wanted.depth) {
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        strategy = hemisphere_method().strategy(input, hemisphere, Workers(1));
        hook().prepare(radiosity, 1e-3);
        hook().begin_step(0);
    }
    [[nodiscard]] StepHook& hook() const {
        StepHook* const found = strategy->step_hook();
        REQUIRE(found);
        return *found;
    }
    /// Rays for the power of a cell, compared with the mean of all power.
    [[nodiscard]] std::vector<double> densities(std::uint32_t patch) const {
        AllocatedCells memory;
        const Allocation allocation = strategy->allocate(patch, memory);
        std::vector<double> result;
        for (std::size_t k = 0; k < allocation.cells.size(); ++k)
            result.push_back(
                hook().rays_for_power(patch) * allocation.rays(k) /
                power_share(hemisphere, allocation.cells[k], CellArea::projected_solid_angle));
        return result;
    }
};

std::vector<Vec3> even_light(const Model& model) {
    return std::vector<Vec3>(model.mesh.patches().size(), Vec3(1.0));
}

constexpr std::size_t patches_of_crowd = 8 * 6;
const Vec3 place_of_crowd(.43, .37, .61);

/// A room with 3 x 3 quads a side, in it eight tiny cubes.
Scene room_with_crowd() {
    const Material wall{"wall", Vec3(.7), Vec3(0.0)}, lamp{"lamp", Vec3(.7), Vec3(1.0)};
    Scene scene = test::box_room(Vec3(0.0), Vec3(1.0), 3, {wall, lamp}, {0, 1, 0, 0, 0, 0});
    for (int corner = 0; corner < 8; ++corner)
        test::add_cube(scene,
                       place_of_crowd + .015 * Vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1),
                       .004);
    return scene;
}

/// Any numbers of rays for the power of a patch.
class Uneven final : public Strategy, StepHook {
  public:
    Allocation allocate(std::uint32_t, AllocatedCells& memory) const override {
        memory.clear();
        memory.add(whole_hemisphere, 1);
        return memory.view();
    }
    [[nodiscard]] StepHook* step_hook() override { return this; }
    [[nodiscard]] double rays_for_power(std::uint32_t patch) const override {
        return patch % 3 == 0 ? .3 : patch % 3 == 1 ? 1 : 4;
    }
};

std::unique_ptr<Strategy> make_uneven(const SolverInput&, const Hemisphere&, const Workers&) {
    return std::make_unique<Uneven>();
}

bool is_finite(const Solution& solution) {
    return std::ranges::all_of(solution.radiosity, [](const Vec3& b) {
        return std::isfinite(b.x) && std::isfinite(b.y) && std::isfinite(b.z);
    });
}

} // namespace

TEST_CASE("Guided by what is seen, no triangle starves and the shares sum to 1") {
    for (const char* const guide : guides)
        for (const Scene& scene : {test::room_with_block(), test::open_scene()})
            for (const int depth : {0, 2, 3}) {
                const Model model(scene);
                SolveOptions options = guided(guide);
                options.depth = depth;
                const Guided made(model, options, even_light(model));
                AllocatedCells memory;
                double most = 0, rays_of_all = 0, power_of_all = 0;
                for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i) {
                    const Allocation allocation = made.strategy->allocate(i, memory);
                    double power = 0, rays = 0, least = 1;
                    for (std::size_t k = 0; k < allocation.cells.size(); ++k) {
                        power += power_share(made.hemisphere, allocation.cells[k],
                                             CellArea::projected_solid_angle);
                        rays += allocation.rays(k);
                    }
                    for (const double density : made.densities(i)) {
                        least = std::min(least, density);
                        most = std::max(most, density);
                    }
                    CHECK(least >= lowest_density * (1 - 1e-9));
                    CHECK(power == Approx(1).epsilon(1e-12));
                    CHECK(rays == Approx(1).epsilon(1e-12));
                    power_of_all += model.mesh.patches()[i].area;
                    rays_of_all += model.mesh.patches()[i].area * made.hook().rays_for_power(i);
                }
                CHECK(rays_of_all == Approx(power_of_all).epsilon(1e-6)); // as many as were asked
                CHECK((depth == 0 || most > 1.3));                        // it does guide
            }
}

TEST_CASE("What hits tell moves rays of both patches, after the step") {
    const Model model(test::room_with_block());
    const Guided made(model, guided("learned"), even_light(model));
    StepHook& hook = made.hook();
    REQUIRE(hook.learns());
    std::uint32_t smallest = 0;
    const auto patches = model.mesh.patches();
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        if (patches[i].area < patches[smallest].area && model.mesh.material(i).reflectance.x > .2)
            smallest = i;
    REQUIRE(smallest != 5);
    constexpr std::size_t t = 11, back = 20;
    AllocatedCells memory;
    const Allocation allocation = made.strategy->allocate(5, memory);
    const std::uint16_t cell = allocation.cells[t], arrival = allocation.cells[back];
    const auto before = made.densities(5), before_there = made.densities(smallest);
    StateWriter untaught, interrupted, taught;
    hook.save(untaught);
    hook.learn(5, cell, std::vector<std::uint32_t>(3000, smallest),
               std::vector<std::uint16_t>(3000, arrival));
    CHECK(made.densities(5) == before);
    hook.save(interrupted);
    CHECK(interrupted.bytes() == untaught.bytes()); // until the step is finished
    hook.end_step();
    hook.save(taught);
    CHECK(taught.bytes() != untaught.bytes());
    hook.prepare(even_light(model), 1e-3);
    const auto after = made.densities(5), after_there = made.densities(smallest);
    CHECK(after[t] > 2 * before[t]);
    CHECK(after[t] > 2 * after[t + 1]);
    CHECK(after_there[back] > before_there[back]);
}

TEST_CASE("A crowd that no patch's own rays find tells of itself") {
    const Model model(room_with_crowd());
    const Guided made(model, guided("visible"), even_light(model));
    const auto patches = model.mesh.patches();
    const auto walls = static_cast<std::uint32_t>(patches.size() - patches_of_crowd);
    int found = 0;
    for (std::uint32_t i = 0; i < walls; ++i) {
        const Vec3 at = model.mesh.frame().to_local(place_of_crowd + Vec3(.0075));
        const Vec3 to_crowd = glm::normalize(at - patches[i].centre);
        const std::size_t leaf =
            made.hemisphere.leaf_at(model.mesh.hemisphere_frame(i).to_local(to_crowd)) -
            Hemisphere::cells_up_to(1);
        std::vector<double> densities = made.densities(i);
        const double there = densities[leaf];
        std::ranges::sort(densities);
        found += there > 1.4 * densities[densities.size() / 2];
    }
    CHECK(found > .7 * walls); // own rays find it from one wall in thirty
}

TEST_CASE("Where light goes round for long, rays are nearly equal") {
    const Model model(room_with_crowd());
    std::vector<Vec3> light;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
        light.push_back(model.mesh.material(i).emission);
    const auto greatest = [&](double bounces) {
        std::vector<Vec3> all = light;
        for (Vec3& b : all)
            b += Vec3(bounces / 6);
        const Guided made(model, guided("visible"), all);
        double most = 0;
        for (std::uint32_t i = 0; i < all.size(); ++i)
            most = std::max(most, std::ranges::max(made.densities(i)));
        return most;
    };
    CHECK(greatest(1) > 5);
    CHECK(greatest(1000) < 1.5);
}

TEST_CASE("Patches may get more and weaker rays without a bias") {
    const Model model(test::room_with_block());
    const Solution exact = test::reference(model, .005);
    SolveOptions options;
    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    ShootingSolver solver(input, make_uneven, {});
    run(solver, input, test::steps(64));
    const ZScores z =
        z_scores(model.mesh, solver.solution(), exact.radiosity, exact.standard_error);
    CHECK(z.count > 200);
    CHECK(std::abs(z.mean) < .2);
    CHECK(z.rms == Approx(1).margin(.15));
}

TEST_CASE("Guided by what is seen, threads change nothing") {
    const Model model(test::room_with_block());
    for (const char* const guide : guides) {
        SolveOptions options = guided(guide);
        options.threads = 1;
        const Solution one = test::solve(model, hemisphere_method(), options, test::steps(3));
        for (const unsigned threads : {2u, 5u}) {
            options.threads = threads;
            const Solution more = test::solve(model, hemisphere_method(), options, test::steps(3));
            CHECK(one.radiosity == more.radiosity);
            CHECK(one.standard_error == more.standard_error);
        }
    }
}

TEST_CASE("Guided by what is seen where there is nothing to see") {
    const Material lamp{"lamp", Vec3(0.0), Vec3(1.0)}, black{"black", Vec3(0.0), Vec3(0.0)};
    Scene one_patch;
    one_patch.materials = {lamp};
    test::add_quad(one_patch, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, 0);
    const Scene black_room =
        test::box_room(Vec3(0.0), Vec3(1.0), 2, {black, lamp}, {0, 1, 0, 0, 0, 0});
    const Scene dark = test::furnace_box(2, .5, 0);
    Scene speck = room_with_crowd();
    test::add_cube(speck, Vec3(.5), 1e-9);
    for (const Scene& scene : {one_patch, black_room, dark, speck})
        for (const char* const guide : guides) {
            const Model model(scene);
            const Guided made(model, guided(guide), even_light(model));
            for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
                for (const double density : made.densities(i))
                    CHECK((density > 0 && std::isfinite(density)));
            CHECK(
                is_finite(test::solve(model, hemisphere_method(), guided(guide), test::steps(6))));
        }
}

TEST_CASE("What was learned goes on from a saved state") {
    const Model model(test::room_with_block());
    for (const char* const guide : guides) {
        const SolveOptions options = guided(guide);
        Monitor monitor;
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        const auto first = hemisphere_method().make(input),
                   second = hemisphere_method().make(input);
        run(*first, input, test::steps(3));
        const std::string saved = test::hand_over(*first, *second);
        for (int step = 0; step < 5; ++step) {
            REQUIRE(first->step());
            REQUIRE(second->step());
        }
        CHECK(first->solution().radiosity == second->solution().radiosity);

        const Model other(test::open_scene());
        const SolverInput elsewhere{other.mesh, other.bvh, options, monitor};
        StateReader foreign(saved);
        CHECK_THROWS_AS(hemisphere_method().make(elsewhere)->load(foreign), StateError);
        SolveOptions deeper = options;
        deeper.depth = 3;
        const SolverInput finer{model.mesh, model.bvh, deeper, monitor};
        StateReader coarse(saved);
        CHECK_THROWS_AS(hemisphere_method().make(finer)->load(coarse), StateError);
    }
}

TEST_CASE("Guided by what is seen, deviations from matrix are the standard errors", "[slow]") {
    for (const Scene& scene : {test::room_with_block(), test::open_scene(), room_with_crowd()}) {
        const Model model(scene);
        const Solution exact = test::reference(model, .002);
        // Rays of unequal power to patches with thirty hits or so: their errors have long tails.
        const bool has_crowd = model.mesh.patches().size() == 54 + patches_of_crowd;
        const double margin = has_crowd ? .25 : .12;
        for (const char* const guide : guides) {
            double mean = 0, squares = 0;
            constexpr int runs = 6; // of some 100 patches whose channels go together
            for (int run = 0; run < runs; ++run) {
                const Solution s =
                    test::solve(model, hemisphere_method(), guided(guide, 40 + std::uint64_t(run)),
                                test::steps(64));
                const ZScores z = z_scores(model.mesh, s, exact.radiosity, exact.standard_error);
                mean += z.mean / runs;
                squares += z.rms * z.rms / runs;
            }
            CAPTURE(model.mesh.patches().size(), mean, std::sqrt(squares));
            CHECK(std::abs(mean) < .12);
            CHECK(std::sqrt(squares) == Approx(1).margin(margin));
        }
    }
}
