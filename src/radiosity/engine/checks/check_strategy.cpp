#include "radiosity/engine/checks/check_strategy.h"

#include "parallel/workers.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/engine/shooting/step_hook.h"
#include "radiosity/engine/shooting/strategy.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace hemilux {

extern const Method matrix_method; // engine/methods/matrix.cpp

namespace {

/// Adds the six sides of a box, which look inwards or outwards.
void add_box(Scene& scene, const Vec3& low, const Vec3& high, bool inwards,
             std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (int corner = 0; corner < 8; ++corner)
        scene.vertices.emplace_back((corner & 1) != 0 ? high.x : low.x,
                                    (corner & 2) != 0 ? high.y : low.y,
                                    (corner & 4) != 0 ? high.z : low.z);
    for (std::array<std::uint32_t, 4> side :
         std::array<std::array<std::uint32_t, 4>, 6>{{{0, 2, 3, 1},
                                                      {4, 5, 7, 6},
                                                      {0, 1, 5, 4},
                                                      {2, 6, 7, 3},
                                                      {0, 4, 6, 2},
                                                      {1, 3, 7, 5}}}) {
        if (inwards)
            std::reverse(side.begin(), side.end());
        for (std::uint32_t& vertex : side)
            vertex += first;
        scene.facets.push_back({side, scene.faces++, material, 0});
    }
}

/// A mesh with its tracer.
struct Room {
    Mesh mesh;
    std::unique_ptr<Tracer> tracer;

    Room(Scene scene, double max_edge)
        : mesh(std::move(scene), {.max_edge = max_edge}), tracer(make_tracer(mesh, 1).tracer) {}
};

/// A room around a block; all of one material, which emits.
Room furnace() {
    Scene scene;
    scene.materials = {{"wall", Vec3(.2, .5, .7), Vec3(1.0)}};
    scene.groups = {"all"};
    add_box(scene, Vec3(0.0), Vec3(1.0), true, 0);
    add_box(scene, {.2, .1, .3}, {.5, .7, .6}, false, 0);
    return {std::move(scene), .26};
}

/// The same with a lamp and unequal walls.
Room lit_room() {
    Scene scene;
    scene.materials = {{"wall", Vec3(.2, .5, .7), Vec3(0.0)},
                       {"block", Vec3(.7, .3, .1), Vec3(0.0)},
                       {"lamp", Vec3(.1), Vec3(10, 8, 6)}};
    scene.groups = {"all"};
    add_box(scene, Vec3(0.0), Vec3(1.0), true, 0);
    add_box(scene, {.2, .1, .3}, {.5, .7, .6}, false, 1);
    add_box(scene, {.6, .6, .8}, {.9, .9, .9}, false, 2);
    return {std::move(scene), .26};
}

/// Blocks without walls.
Room open_scene() {
    Scene scene;
    scene.materials = {{"block", Vec3(.5), Vec3(1.0)}};
    scene.groups = {"all"};
    for (int k = 0; k < 4; ++k)
        add_box(scene, {k * 1.0, .3 * k, 0}, {k + .8, .3 * k + .5, 1 + .2 * k}, false, 0);
    return {std::move(scene), .5};
}

/// Faults of a strategy, each kind once.
class Faults {
  public:
    void add(bool holds, const std::string& text) {
        if (!holds && std::ranges::find(texts_, text) == texts_.end())
            texts_.push_back(text);
    }
    [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }

  private:
    std::vector<std::string> texts_;
};

/// A cell's share of the power, as the strategy has it and by Lambert's law.
struct Power {
    double given, due;
};

/// Returns nothing for a cell that is neither of the hemisphere nor private.
std::optional<Power> power_of(const Strategy& strategy, const Hemisphere& hemisphere,
                              const Mesh& mesh, std::uint32_t patch, std::uint16_t cell) {
    const PrivateCells* const own = strategy.private_cells();
    if (const auto found = own ? own->private_cell(patch, cell) : std::nullopt)
        return Power{found->power, found->shape.projected_solid_angle() / std::numbers::pi *
                                       found->origins.area() / mesh.patches()[patch].area};
    if (cell == whole_hemisphere)
        return Power{1, 1};
    if (cell >= hemisphere.cells().size())
        return std::nullopt;
    const double due = hemisphere.cells()[cell].projected_solid_angle / std::numbers::pi;
    return Power{due, due};
}

void check_allocation(const Strategy& strategy, const Hemisphere& hemisphere, const Mesh& mesh,
                      std::uint32_t patch, Faults& faults) {
    constexpr double rounding = 1e-6;
    AllocatedCells memory;
    const Allocation found = strategy.allocate(patch, memory);
    faults.add(found.cells.size() == found.rays_up_to.size(),
               "there are not as many sums of rays as cells");
    if (found.cells.size() != found.rays_up_to.size())
        return;
    double power = 0, rays = 0;
    for (std::size_t k = 0; k < found.cells.size(); ++k) {
        const auto of = power_of(strategy, hemisphere, mesh, patch, found.cells[k]);
        faults.add(of.has_value(), "a cell is neither of the hemisphere nor private");
        if (!of)
            continue;
        faults.add(std::abs(of->given - of->due) <= rounding,
                   "a cell has not the power of Lambert's law");
        faults.add(found.rays(k) >= 0, "a cell has less than no rays");
        faults.add(of->given <= 0 || found.rays(k) > 0, "a cell with power has no rays");
        power += of->given;
        rays += found.rays(k);
    }
    faults.add(std::abs(power - 1) <= rounding,
               "the cells of a patch have not all of its power, or some of it twice");
    faults.add(std::abs(rays - 1) <= 1e-9, "the shares of rays do not sum to 1");
}

void check_allocations(const Method& method, const Room& room, Faults& faults) {
    for (const int depth : {0, 2, 3}) {
        SolveOptions options;
        options.depth = depth;
        Monitor monitor;
        const Hemisphere hemisphere(depth);
        const SolverInput input{room.mesh, *room.tracer, options, monitor};
        const std::unique_ptr<Strategy> strategy = method.strategy(input, hemisphere, Workers(1));
        for (const std::uint64_t step : {0u, 2u, 5u}) {
            if (StepHook* const hook = strategy->step_hook())
                hook->begin_step(step);
            for (std::uint32_t i = 0; i < room.mesh.patches().size(); i += 3)
                check_allocation(*strategy, hemisphere, room.mesh, i, faults);
        }
    }
}

Solution solve(const Method& method, const Room& room, const StopRule& stop, std::uint64_t seed,
               unsigned threads) {
    SolveOptions options;
    options.seed = seed;
    options.threads = threads;
    options.stop = stop;
    Monitor monitor;
    const SolverInput input{room.mesh, *room.tracer, options, monitor};
    const std::unique_ptr<EngineSolver> solver = method.make(input);
    run(*solver, input, stop);
    return solver->solution();
}

/// Judges the differences from a reference, in standard errors.
void check_light(const Mesh& mesh, const Solution& found, const Solution& reference,
                 const std::string& where, Faults& faults) {
    const ZScores z = z_scores(mesh, found, reference.radiosity, reference.standard_error);
    constexpr double most_rms = 1.3, most_mean = .35, most = 7;
    faults.add(z.rms < most_rms && std::abs(z.mean) < most_mean && z.largest < most,
               where + ": light is off by " + std::to_string(z.rms) +
                   " standard errors (RMS), in the mean by " + std::to_string(z.mean));
}

} // namespace

std::vector<std::string> check_strategy(const Method& method, unsigned threads) {
    if (!method.strategy)
        throw std::invalid_argument(std::string(method.name) + " has no strategy");
    Faults faults;
    const Room closed = furnace(), lit = lit_room();
    for (const Room* const room : {&closed, &lit})
        check_allocations(method, *room, faults);
    check_allocations(method, open_scene(), faults);
    if (!method.unbiased || !faults.texts().empty())
        return faults.texts();
    constexpr std::uint32_t steps = 64;
    const StopRule stop{.steps = steps, .seconds = {}, .error = {}};
    Solution even = solve(method, closed, stop, 1, threads), exact = even;
    for (std::uint32_t i = 0; i < exact.radiosity.size(); ++i) {
        const Material& material = closed.mesh.material(i);
        exact.radiosity[i] = material.emission / (1.0 - material.reflectance);
        exact.standard_error[i] = Vec3(0.0);
    }
    check_light(closed.mesh, even, exact, "a closed room of one material", faults);
    const StopRule good{.steps = {}, .seconds = {}, .error = .002};
    check_light(lit.mesh, solve(method, lit, stop, 1, threads),
                solve(matrix_method, lit, good, 2, threads), "a room with a block", faults);
    return faults.texts();
}

} // namespace hemilux
