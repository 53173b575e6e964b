// What every strategy owes, whatever it guides its rays by: shares that sum to 1, Lambert's law,
// and rays for every cell that carries power.
#include "parallel/workers.h"
#include "radiosity/engine/shooting/step_hook.h"
#include "radiosity/engine/shooting/strategy.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <numbers>

using namespace hemilux;
using test::Model;

namespace {

struct Allocator {
    SolveOptions options;
    Monitor monitor;
    Hemisphere hemisphere;
    std::unique_ptr<Strategy> strategy;

    Allocator(const Model& model, const Method& method, const SolveOptions& wanted)
        : options(wanted), hemisphere(wanted.depth) {
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        strategy = method.strategy(input, hemisphere, Workers(1));
    }
};

/// What one cell got, and the power that Lambert's law gives it.
struct Allocated {
    double power, rays, due;
};

std::vector<Allocated> allocate(const Model& model, const Allocator& allocator,
                                std::uint32_t patch) {
    AllocatedCells memory;
    const Allocation allocation = allocator.strategy->allocate(patch, memory);
    REQUIRE(allocation.cells.size() == allocation.rays_up_to.size());
    std::vector<Allocated> result;
    for (std::size_t k = 0; k < allocation.cells.size(); ++k) {
        const std::uint16_t cell = allocation.cells[k];
        const PrivateCells* const its = allocator.strategy->private_cells();
        if (const auto own = its ? its->private_cell(patch, cell) : std::nullopt)
            result.push_back({own->power, allocation.rays(k),
                              own->shape.projected_solid_angle() / std::numbers::pi *
                                  own->origins.area() / model.mesh.patches()[patch].area});
        else if (cell == whole_hemisphere)
            result.push_back({1, allocation.rays(k), 1});
        else
            result.push_back(
                {power_share(allocator.hemisphere, cell,
                             allocator.options.literal ? CellArea::solid_angle
                                                       : CellArea::projected_solid_angle),
                 allocation.rays(k),
                 allocator.hemisphere.cells()[cell].projected_solid_angle / std::numbers::pi});
    }
    return result;
}

/// Calls test(cells) for many patches of several scenes, depths, thresholds and steps.
template <class Test>
void for_all_allocations(const Method& method, bool literal, const Test& test_cells) {
    for (const Scene& scene :
         {test::room_with_block(), test::open_scene(), test::furnace_l_shape(.5)}) {
        const Model model(scene);
        for (const int depth : {0, 2, 3})
            for (const double threshold : {0.0, 1.3, 3.0}) {
                SolveOptions options;
                options.depth = depth;
                options.threshold = threshold;
                options.literal = literal;
                const Allocator allocator(model, method, options);
                for (const std::uint64_t step : {0u, 2u, 5u}) {
                    if (StepHook* const hook = allocator.strategy->step_hook())
                        hook->begin_step(step);
                    for (std::uint32_t i = 0; i < model.mesh.patches().size(); i += 5)
                        test_cells(allocate(model, allocator, i));
                }
            }
    }
}

} // namespace

TEST_CASE("Shares of power and rays sum to 1, and follow Lambert's law") {
    for (const Method* method : methods()) {
        if (!method->strategy)
            continue;
        INFO(method->name);
        // Triangles that shrink where surfaces are get equal rays, however large they are.
        const double fewest_rays = method->name == "hemisphere-1997" ? 1e-3 : .1;
        for_all_allocations(*method, false, [&](const std::vector<Allocated>& cells) {
            double power = 0, rays = 0, worst = 0, least = 1;
            for (const Allocated& cell : cells) {
                power += cell.power;
                rays += cell.rays;
                worst = std::max(worst, std::abs(cell.power - cell.due));
                least = std::min(least, cell.rays / cell.power);
            }
            CHECK(power == Approx(1).epsilon(1e-12));
            CHECK(rays == Approx(1).epsilon(1e-12));
            CHECK(worst < 1e-14);
            CHECK(least > fewest_rays); // every cell with power gets rays
        });
    }
}

TEST_CASE("Running sums give small cells their rays, and none where none are due") {
    AllocatedCells memory;
    memory.add(0, 1 - 1e-9);
    for (std::uint16_t cell = 1; cell < 1000; ++cell)
        memory.add(cell, cell % 2 == 0 ? 0 : 2e-12);
    const Allocation allocation = memory.view();
    CHECK(allocation.rays(0) == 1 - 1e-9);
    for (std::size_t k = 1; k < 1000; ++k)
        CHECK(allocation.rays(k) == Approx(k % 2 == 0 ? 0 : 2e-12).epsilon(1e-3));
    CHECK(allocation.rays_up_to.back() == Approx(1).epsilon(1e-12));
}

TEST_CASE("The printed rule breaks Lambert's law by what was measured elsewhere") {
    // A triangle of level 2 gets .51 to 3.80 times its due.
    double lowest = 10, highest = 0, sum = 0;
    const Hemisphere hemisphere(2);
    for (std::size_t c = Hemisphere::cells_up_to(1); c < hemisphere.cells().size(); ++c) {
        const auto& cell = hemisphere.cells()[c];
        const double ratio = cell.solid_angle / 2 / cell.projected_solid_angle;
        lowest = std::min(lowest, ratio);
        highest = std::max(highest, ratio);
    }
    CHECK(lowest == Approx(.51).margin(.005));
    CHECK(highest == Approx(3.80).margin(.005));
    for_all_allocations(*find_method("hemisphere"), true, [&](const std::vector<Allocated>& cells) {
        sum = 0;
        for (const Allocated& cell : cells)
            sum += cell.power;
        CHECK(sum == Approx(1).epsilon(1e-12)); // so a balance of energy does not see it
    });
}

TEST_CASE("Guidance sends rays where surfaces were counted") {
    const Model model(test::room_with_block());
    const Allocator guided(model, *find_method("hemisphere"), {});
    const Allocator plain(model, *find_method("stratified"), {});
    double difference = 0;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i) {
        const std::vector<Allocated> cells = allocate(model, guided, i);
        REQUIRE(cells.size() == 64);
        REQUIRE(allocate(model, plain, i).size() == 64);
        for (const Allocated& cell : cells)
            difference = std::max(difference, cell.rays / cell.power);
    }
    CHECK(difference > 1.5);
    CHECK(guided.strategy->density_rays() == 41 * model.mesh.patches().size());
    CHECK(plain.strategy->density_rays() == 0);
    CHECK(plain.strategy->density_bytes() == 0);
}
